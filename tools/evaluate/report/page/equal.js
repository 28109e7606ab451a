// What other kinds of drawing come to in the time, and with the error, of one renderer.

function makeEqual() {
  const { subject, kinds, cameras: seen } = report.equal ?? { kinds: [], cameras: [] };
  byId("equal").hidden = !kinds.length;
  if (!kinds.length) return;
  const numeric = (title, hint, value, format) => ({ title, hint, numeric: true, value, text: (row) => format(value(row)) });
  const kindColumn = { title: "Against", hint: "", value: (row) => row.kind, cell: (row) => kindCell(row.kind) };
  const share = (of) => (row) => `${row[of]} of ${row.cameras}`;
  makeTable(byId("equal-summary"), [kindColumn,
    { title: "Less error in the same time", hint: `Cameras from which ${subject} has less error in its time`, numeric: true,
      value: (row) => row.subjectBetter / row.cameras, text: share("subjectBetter") },
    numeric("Error ÷ its error", "Geometric mean where it can be as fast", (row) => row.errorRatio, fixed(3)),
    numeric("worst", "Where it can be as fast", (row) => row.worstErrorRatio, fixed(3)),
    { title: "Never as fast", hint: "Cameras from which it takes longer, whatever its settings", numeric: true,
      value: (row) => row.neverAsFast / row.cameras, text: share("neverAsFast") },
    numeric("Faster at its error", `Its time for the error of ${subject} over ${subject}'s; geometric mean where it has it`,
      (row) => row.speed, fixed(2)),
    numeric("least", "The least of these", (row) => row.leastSpeed, fixed(2)),
    { title: "Never as good", hint: "Cameras from which it has more error, whatever its settings", numeric: true,
      value: (row) => row.neverAsGood / row.cameras, text: share("neverAsGood") },
  ], kinds);
  byId("equal-note").textContent = `${subject} against the others, each along the front of its settings in this run, between ` +
    "them by logarithms.";
  const rows = seen.flatMap((camera) => camera.kinds.map((entry) => ({ camera: camera.camera, ...entry })));
  makeTable(byId("equal-cameras"), [
    { title: "Camera", hint: "", value: (row) => row.camera, text: (row) => row.camera || "(no name)" }, kindColumn,
    numeric(`${subject}, ms`, "Median", (row) => row.ms, figure), numeric("its error in that time", "", (row) => row.errorThere, figure),
    numeric(`${subject}, error`, "", (row) => row.error, figure), numeric("its ms for that error", "", (row) => row.msThere, figure),
    numeric("times faster", "", (row) => (row.msThere === null ? null : row.msThere / row.ms), fixed(2)),
  ], rows);
}

function kindCell(kind) {
  const renderer = renderers.find((item) => item.base === kind);
  return element("span", { class: "renderer" }, ...(renderer ? [swatch(renderer)] : []), kind);
}
