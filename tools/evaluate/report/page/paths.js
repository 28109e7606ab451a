// Camera paths: a figure over the frames, a line a renderer; what they come to; the worst frames' pictures.

const pathFigures = {
  flicker: { name: "Flicker", truth: true,
    text: "Mean |change of the picture since the frame before − change of the reference| over the image (0–255)." },
  paperError: { name: "Error", text: figures.paperError.text },
  ownChange: { name: "Change of the picture", truth: true, text: "Mean |change since the frame before| (0–255)." },
  ms: { name: "Frame, ms", text: "Wall time, with the pages that the frame read." },
  cpuMs: { name: "CPU, ms", text: "Processor time of the whole process." },
  bytesRead: { name: "Bytes read", tick: bytes, text: "Of the pack, for this frame." },
  viewSwitches: { name: "Cells that took another view", text: "Since the frame before." },
  levelSwitches: { name: "Cells that took another level or representation", text: "Since the frame before." },
  triangles: { name: "Triangles", tick: short, text: "Drawn in the frame." },
  impostors: { name: "Cells drawn as impostors", tick: short, text: "In the frame." },
};
const pathPlot = { path: paths[0], key: "flicker" };

// Change and flicker begin with the second frame.
const firstFrame = (key) => (["flicker", "ownChange", "viewSwitches", "levelSwitches"].includes(key) ? 1 : 0);
const shownRuns = () => pathPlot.path.renderers.filter((run) => !choice.hidden.has(run.renderer));
const referenceChange = () => pathPlot.path.renderers[0].frames.referenceChange ?? [];

function pathLine(values, first, attributes) {
  const points = values.slice(first).map((value, i) =>
    `${pathPlot.x.at(i + first).toFixed(1)},${pathPlot.y.at(value).toFixed(1)}`);
  return shape("polyline", { points: points.join(" "), ...attributes });
}

// At frames in which cells switched.
function switchMarks(run) {
  const { viewSwitches, levelSwitches } = run.frames, values = run.frames[pathPlot.key], renderer = rendererOf(run);
  return values.flatMap((value, i) => (i > 0 && viewSwitches[i] + levelSwitches[i] > 0
    ? [markShape({ renderer, px: pathPlot.x.at(i), py: pathPlot.y.at(value) }, "switch", 2.6)] : []));
}

function drawPath() {
  const plot = pathPlot, item = pathFigures[plot.key], first = firstFrame(plot.key), runs = shownRuns();
  plot.width = plotWidth(plot);
  plot.height = Math.round(Math.min(420, Math.max(280, plot.width * 0.4)));
  plot.svg.replaceChildren();
  fill(plot.svg, { viewBox: `0 0 ${plot.width} ${plot.height}`, width: plot.width, height: plot.height }, []);
  const truth = item.truth ? referenceChange() : [];
  const values = [...runs.flatMap((run) => run.frames[plot.key].slice(first)), ...truth.slice(1)];
  if (!values.length) {
    plot.svg.append(shape("text", { x: plot.width / 2, y: plot.height / 2, class: "title x" }, "No frame to show"));
    return;
  }
  plot.x = makeScale([0, Math.max(1, plot.path.frames - 1)], false, margin.left, plot.width - margin.right, 56);
  plot.y = makeScale([...values, 0], false, plot.height - margin.bottom, margin.top, 30);
  const tick = item.tick ?? ((value) => String(Number(value.toPrecision(3))));
  plot.cursor = shape("g", { class: "overlay" });
  plot.svg.append(axisShapes(plot, plot.x, plot.y, { name: "Frame", tick: String }, { name: item.name, tick }));
  if (truth.length) plot.svg.append(pathLine(truth, 1, { class: "truth" }));
  for (const run of runs)
    plot.svg.append(pathLine(run.frames[plot.key], first, { class: "run", style: `stroke:${rendererOf(run).colour}` }),
      ...switchMarks(run));
  plot.svg.append(plot.cursor);
}

function frameAt(event) {
  const box = pathPlot.svg.getBoundingClientRect(), x = (event.clientX - box.left) * pathPlot.width / box.width;
  const from = pathPlot.x.at(0), to = pathPlot.x.at(1);
  return Math.min(pathPlot.path.frames - 1, Math.max(firstFrame(pathPlot.key), Math.round((x - from) / (to - from))));
}

function showFrame(frame) {
  const plot = pathPlot, hidden = frame === null || !plot.cursor || !(frame < plot.path.frames);
  plot.cursor?.replaceChildren();
  plot.readout.hidden = hidden;
  if (hidden) return;
  const px = plot.x.at(frame);
  plot.cursor.append(shape("line", { x1: px, x2: px, y1: margin.top, y2: plot.height - margin.bottom, class: "cursor" }));
  const rows = shownRuns().map((run) => ({ run, value: run.frames[plot.key][frame] })).sort((a, b) => b.value - a.value);
  const told = ({ run, value }) => {
    const switched = run.frames.viewSwitches[frame] + run.frames.levelSwitches[frame];
    return [element("dt", {}, swatch(rendererOf(run)), " ", run.renderer),
      element("dd", {}, figure(value) + (switched ? ` · ${switched} switched` : ""))];
  };
  plot.readout.replaceChildren(element("b", {}, `Frame ${frame}`), element("dl", {},
    ...(pathFigures[plot.key].truth ? [element("dt", {}, "the reference's change"),
      element("dd", {}, figure(referenceChange()[frame]))] : []), ...rows.flatMap(told)));
  const left = px * plot.svg.getBoundingClientRect().width / plot.width;
  const aside = left > plot.width / 2 ? `right:${plot.width - left + 30}px` : `left:${left + 30}px`;
  fill(plot.readout, { style: `${aside};top:${margin.top + 40}px` }, []);
}

function makePathTable() {
  const numeric = (title, hint, key, format) => ({ title, hint, numeric: true, value: (row) => row.summary[key],
    text: (row) => format(row.summary[key]) });
  makeTable(byId("path-summary"), [
    { title: "Renderer", hint: "", value: (row) => row.renderer, cell: (row) => rendererCell(row.renderer) },
    numeric("Flicker", `${pathFigures.flicker.text} Mean over the frames.`, "meanFlicker", figure),
    numeric("÷ full-4spp", "Its flicker over that of full geometry at four samples a pixel", "flickerToFull4spp", fixed(3)),
    numeric("p99", "99th percentile of the frames' flicker", "p99Flicker", figure),
    numeric("Worst", "The largest flicker of a frame", "worstFlicker", figure),
    numeric("in frame", "The first frame of the largest flicker", "worstFrame", String),
    numeric("Switches in", "Frames in which a cell took another view, level or representation", "switchFrames", String),
    numeric("Flicker there", "Mean over those frames", "flickerAtSwitches", figure),
    numeric("elsewhere", "Mean over the other frames", "flickerElsewhere", figure),
    numeric("Worst pop", "The largest flicker of a frame with switches over the reference's own mean change",
      "worstPopToReference", fixed(3)),
    numeric("Reference changes", "Mean |change of the reference since the frame before|", "referenceChange", figure),
    numeric("Error", "Mean over the frames", "meanError", figure),
    numeric("Frame, ms", "Median", "medianMs", figure),
    numeric("p99, ms", "99th percentile", "p99Ms", figure),
  ], pathPlot.path.renderers);
}

function worstPictures(run) {
  const file = (end) => `${encodeURIComponent(pathPlot.path.stem)}.${encodeURIComponent(run.renderer)}.${end}.png`;
  const shown = (end, text) => {
    const node = element("img", { src: file(end), alt: `${run.renderer}, ${text}`, loading: "lazy",
      width: report.size[0], height: report.size[1] });
    node.addEventListener("error", () => node.replaceWith(element("span", { class: "absent" }, `${file(end)} is not there`)));
    return element("a", { class: "thumbnail", href: file(end) }, node, element("span", { class: "caption" }, text));
  };
  const { worstFrame, worstFlicker, meanFlicker } = run.summary;
  return element("section", { class: "worst" }, element("h3", { class: "renderer" }, swatch(rendererOf(run)),
    `${run.renderer}, frame ${worstFrame}: flicker ${figure(worstFlicker)}, mean ${figure(meanFlicker)}`),
  element("div", { class: "strip" }, shown("worst-before", "the frame before"), shown("worst", "picture"),
    shown("worst-reference", "reference"), shown("worst-flicker", `flicker, ${report.differenceGain} times`)));
}

function pathChanged() {
  drawPath();
  makePathTable();
  byId("path-pictures").replaceChildren(...pathPlot.path.renderers.filter((run) => run.summary.frames > 0).map(worstPictures));
}

function makePaths() {
  const plot = pathPlot;
  Object.assign(plot, { figure: byId("path-plot"), svg: shape("svg", { role: "img", "aria-label": "Frames of a path" }),
    readout: element("div", { class: "readout", hidden: true }) });
  const pathChooser = select(paths.map((path, i) => [String(i), path.name]), "0", (index) => {
    plot.path = paths[Number(index)];
    pathChanged();
  });
  const figureChooser = select(Object.entries(pathFigures).map(([key, item]) => [key, item.name]), plot.key, (key) => {
    plot.key = key;
    drawPath();
  });
  plot.figure.append(element("figcaption", {}, element("label", {}, "Path ", pathChooser),
    element("label", {}, "Figure ", figureChooser), ...plot.path.renderers.map((run) =>
      element("span", { class: "renderer" }, swatch(rendererOf(run)), run.renderer))), plot.svg, plot.readout);
  plot.svg.addEventListener("pointermove", (event) => showFrame(frameAt(event)));
  plot.svg.addEventListener("pointerleave", () => showFrame(null));
  addEventListener("resize", () => plot.width !== plotWidth(plot) && drawPath());
  pathChanged();
}
