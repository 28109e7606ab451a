// Tables that are sorted by a click on a heading. column: { title, hint, value(row), text(row) or cell(row), numeric }

function compareValues(a, b) {
  if (a === null || b === null) return (a === null) - (b === null);
  return typeof a === "number" ? a - b : String(a).localeCompare(String(b), undefined, { numeric: true });
}

// Nothing known sorts last, whichever way. rowAttributes(row): of its tr.
function makeTable(table, columns, rows, rowAttributes) {
  const body = element("tbody");
  const made = rows.map((row) => ({ row, node: element("tr", rowAttributes ? rowAttributes(row) : {},
    ...columns.map((column, i) => element(i === 0 ? "th" : "td", { class: column.numeric ? "number" : null,
      scope: i === 0 ? "row" : null }, column.cell ? column.cell(row) : column.text(row)))) }));
  const headings = columns.map((column) => element("th", { scope: "col", class: column.numeric ? "number" : null },
    element("button", { type: "button", title: column.hint }, column.title)));
  const sort = (index, down) => {
    const column = columns[index];
    const order = down ? "descending" : "ascending";
    headings.forEach((heading, i) => heading.setAttribute("aria-sort", i === index ? order : "none"));
    made.sort((a, b) => {
      const x = column.value(a.row), y = column.value(b.row), sign = down && x !== null && y !== null ? -1 : 1;
      return sign * compareValues(x, y);
    });
    body.append(...made.map((item) => item.node));
  };
  headings.forEach((heading, index) => heading.firstChild.addEventListener("click", () =>
    sort(index, heading.getAttribute("aria-sort") === "ascending")));
  body.append(...made.map((item) => item.node));
  table.replaceChildren(element("thead", {}, element("tr", {}, ...headings)), body);
  return made;
}

function rendererCell(name) {
  const renderer = renderers.find((item) => item.name === name);
  return element("span", { class: "renderer" }, ...(renderer ? [swatch(renderer)] : []), name);
}

function makeSummary() {
  const rows = Object.entries(report.summary).map(([name, summary]) => ({ name, ...summary }));
  const most = Math.max(...rows.map((row) => row.ratioToFull1spp ?? 0), 1e-9);
  const numeric = (title, hint, value, format) =>
    ({ title, hint, numeric: true, value, text: (row) => format(value(row)) });
  const part = (group) => (row) => row[group].cameras
    ? `${fixed(3)(row[group].ratioToFull1spp)} (${row[group].cameras})` : missing;
  const bar = (row) => {
    const renderer = renderers.find((item) => item.name === row.name);
    const width = (100 * (row.ratioToFull1spp ?? 0) / most).toFixed(1);
    return element("span", { class: "bar" },
      element("span", {}, element("span", { style: `width:${width}%;background:${renderer?.colour}` })),
      fixed(3)(row.ratioToFull1spp));
  };
  makeTable(byId("summary"), [
    { title: "Renderer", hint: "", value: (row) => row.name, cell: (row) => rendererCell(row.name) },
    { title: "Ratio", hint: "Geometric mean over all cameras", numeric: true, value: (row) => row.ratioToFull1spp,
      cell: bar },
    numeric("Worst", "The worst camera's ratio", (row) => row.worstRatio, fixed(3)),
    numeric("Worst holes, %", figures.holeRate.text, (row) => row.worstHoleRate, percent),
    numeric("Frame, ms", "Median over cameras", (row) => row.medianFrameMs, figure),
    numeric("Triangles", "Median over cameras", (row) => row.medianTriangles, whole),
    { title: "Front", hint: "No other has less error in as little time, or as little error in less",
      value: (row) => (row.onParetoFront ? 1 : 0), text: (row) => (row.onParetoFront ? "●" : "") },
    { title: "Mostly impostors (n)", hint: "Ratio where impostors draw at least 80 % of the foreground", numeric: true,
      value: (row) => row.mostlyImpostors.ratioToFull1spp, text: part("mostlyImpostors") },
    { title: "Elsewhere (n)", hint: "Ratio of the other cameras", numeric: true,
      value: (row) => row.elsewhere.ratioToFull1spp, text: part("elsewhere") },
    numeric("FLIP", "Mean over cameras", (row) => row.meanFlip, fixed(4)),
    { title: "Class", hint: "", value: (row) => row.class, text: (row) => row.class },
  ], rows);
}

function makeEntries() {
  const columns = [
    { title: "Camera", hint: "", value: (entry) => entry.camera, text: (entry) => entry.camera || "(no name)" },
    { title: "Renderer", hint: "", value: (entry) => renderers.indexOf(rendererOf(entry)),
      cell: (entry) => rendererCell(entry.renderer) },
    ...tableKeys.map((key) => figures[key]).map((item) => ({ title: item.name + (item.unit ? `, ${item.unit}` : ""),
      hint: item.text, numeric: true, value: item.read, text: (entry) => item.format(item.read(entry)) })),
  ];
  const made = makeTable(byId("entries"), columns, entries, (entry) =>
    ({ onclick: () => showPictures(entry), title: "Show its pictures" }));
  const show = () => {
    const wanted = byId("filter").value.toLowerCase();
    let count = 0;
    for (const { row, node } of made) {
      node.hidden = !`${row.camera} ${row.renderer}`.toLowerCase().includes(wanted);
      count += node.hidden ? 0 : 1;
    }
    byId("shown").textContent = `${count} of ${entries.length} entries`;
  };
  byId("filter").addEventListener("input", show);
  show();
}
