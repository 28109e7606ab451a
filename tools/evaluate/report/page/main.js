// Fills the page.

const pictureSize = `${report.size[0]} × ${report.size[1]} pixels`;

function makeHeader() {
  byId("version").textContent = ` ${report.version}`;
  byId("title").textContent = report.pack.name;
  document.title = `${report.pack.name} – farcell report`;
  const seen = [cameras.length ? `${cameras.length} cameras` : "", paths.length ? `${paths.length} camera paths` : ""];
  byId("lead").textContent = `${whole(report.pack.triangles)} triangles from ${report.pack.source}, ` +
    `${seen.filter(Boolean).join(", ")}, ${renderers.length} renderers, pictures of ${pictureSize} ` +
    `against ${report.reference.samples} samples a pixel of the full geometry.`;
  const incomplete = byId("incomplete");
  incomplete.hidden = report.complete;
  incomplete.textContent = "Incomplete: the run was interrupted or failed, and cameras are missing. " +
    "What is here stands; means and medians are of these cameras alone.";
}

function card(title, pairs) {
  return element("section", {}, element("h3", {}, title), element("dl", {}, ...pairs.flatMap(([name, value]) =>
    [element("dt", {}, name), element("dd", {}, value)])));
}

function colourValue(rgb) {
  const text = rgb.map((value) => Math.round(value)).join(", ");
  return element("span", {}, element("span", { class: "patch", style: `background:rgb(${text})` }), text);
}

function makeSettings() {
  const { pack, reference, light, machine } = report;
  byId("settings").append(
    card("Pack", [["File", `${pack.name}, ${bytes(pack.bytes)}`], ["Model", pack.source], ["Its hash", pack.sourceHash],
      ["Triangles", whole(pack.triangles)], ["Views of a cell", String(pack.views)],
      ["View", `${pack.imageSize} × ${pack.imageSize} texels, ${pack.samples} samples each`],
      ["Triangles of a leaf", `at most ${whole(pack.leafTriangles)}`]]),
    card("Reference", [
      ["Geometry", `${reference.kind === "mesh" ? "the original file" : "the pack's own triangles"}, ray traced`],
      ["Samples a pixel", String(reference.samples)], ["Time, all cameras", `${figure(reference.seconds)} s`],
      ["Picture", pictureSize], ["Background", colourValue(report.background)],
      ["Light", `${light.text}; ambient ${figure(light.ambient)}, diffuse ${figure(light.diffuse)}`]]),
    card("Machine", [["Processor", machine.processor], ["Threads", String(machine.threads)], ["OpenGL", report.gl],
      ["Timed frames", `${report.timedFrames} warm ones after a cold one`], ["farcell", report.version]]));
  const names = [...new Set(renderers.flatMap((renderer) => Object.keys(renderer.settings)))];
  makeTable(byId("renderer-settings"), [
    { title: "Renderer", hint: "", value: (row) => row.name, cell: (row) => rendererCell(row.name) },
    ...names.map((name) => ({ title: name, hint: "", value: (row) => row.settings[name] ?? null,
      text: (row) => String(row.settings[name] ?? missing) })),
  ], renderers);
  byId("definitions").append(...tableKeys.flatMap((key) =>
    [element("dt", {}, figures[key].name), element("dd", {}, figures[key].text)]));
}

function plotsChanged() {
  plots.forEach(drawPlot);
  writeAddress();
}

function picturesChanged() {
  drawPictures();
  writeAddress();
}

readAddress();
makeHeader();
for (const section of document.querySelectorAll("main > section"))
  section.hidden = section.classList.contains("of-paths") ? !paths.length : section.classList.contains("of-cameras") && !cameras.length;
if (cameras.length) {
  makeSummary();
  makeFront();
  makeEqual();
  makeSuns();
  makePlots();
  makePictures();
  makeEntries();
}
if (paths.length) makePaths();
for (const link of document.querySelectorAll('nav > a[href^="#"]'))
  link.hidden = byId(link.hash.slice(1)).parentNode.hidden;
makeSettings();
