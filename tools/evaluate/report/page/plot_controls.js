// What a reader does with the plots: pointing, clicking, choosing.

function nearestPoint(plot, event) {
  const box = plot.svg.getBoundingClientRect();
  const x = (event.clientX - box.left) * plot.width / box.width;
  const y = (event.clientY - box.top) * plot.height / box.height;
  let best = null, bestDistance = 30;
  for (const point of plot.points) {
    const distance = Math.hypot(point.px - x, point.py - y);
    if (distance < bestDistance) [best, bestDistance] = [point, distance];
  }
  return best;
}

// In every plot: the entry ringed, its camera's other entries joined by a line in the order of their cost.
function markEntry(plot, entry) {
  plot.overlay?.replaceChildren();
  if (!entry || !plot.overlay) return;
  const same = plot.points.filter((point) => point.entry.stem === entry.stem).sort((a, b) => a.px - b.px);
  plot.overlay.append(shape("polyline", { class: "thread",
    points: same.map((point) => `${point.px.toFixed(1)},${point.py.toFixed(1)}`).join(" ") }));
  for (const point of same)
    plot.overlay.append(point.entry === entry ? markShape(point, "ring", 6) : markShape(point, "same", 4));
}

function showReadout(point, source) {
  for (const plot of plots) {
    markEntry(plot, point?.entry);
    plot.readout.hidden = !point || plot !== source;
  }
  if (!point) return;
  const { entry, renderer } = point;
  const always = ["paperError", "ratioToFull1spp", "flip", "psnr", "impostorShare"];
  const keys = new Set([choice.metric, ...choice.costs, ...always]);
  source.readout.replaceChildren(element("b", {}, entry.camera), element("div", {}, swatch(renderer), entry.renderer),
    element("dl", {}, ...[...keys].flatMap((key) => [element("dt", {}, figures[key].name),
      element("dd", {}, figureText(figures[key], entry))])));
  const box = source.svg.getBoundingClientRect(), figureBox = source.figure.getBoundingClientRect();
  const scale = box.width / source.width, left = box.left - figureBox.left + point.px * scale;
  const top = box.top - figureBox.top + point.py * scale;
  // Towards the middle of the figure, where there is room.
  const aside = left > figureBox.width / 2 ? `right:${figureBox.width - left + 14}px` : `left:${left + 14}px`;
  const below = top > figureBox.height / 2 ? `bottom:${figureBox.height - top + 10}px` : `top:${top + 10}px`;
  fill(source.readout, { style: `${aside};${below}` }, []);
}

function makePlot(figureNode, index) {
  const plot = { figure: figureNode, index, points: [], svg: shape("svg", { role: "img" }),
    note: element("p", { class: "note" }), readout: element("div", { class: "readout", hidden: true }) };
  plot.log = element("input", { type: "checkbox", onchange: () => drawPlot(plot) });
  const setLog = () => { plot.log.checked = Boolean(figures[choice.costs[index]].log); };
  setLog();
  const chooser = select(costKeys.map((key) => [key, axisName(figures[key])]), choice.costs[index], (key) => {
    choice.costs[index] = key;
    setLog();
    plotsChanged();
  });
  figureNode.append(element("figcaption", {}, element("label", {}, "against ", chooser),
    element("label", { class: "check" }, plot.log, " log")), plot.svg, plot.readout, plot.note);
  plot.svg.addEventListener("pointermove", (event) => showReadout(nearestPoint(plot, event), plot));
  plot.svg.addEventListener("pointerleave", () => showReadout(null));
  plot.svg.addEventListener("click", (event) => {
    const point = nearestPoint(plot, event);
    if (point) showPictures(point.entry);
  });
  plots.push(plot);
}

function makeLegend() {
  const node = byId("legend");
  const draw = () => {
    node.replaceChildren(...renderers.map((renderer) => element("button", { type: "button",
      "aria-pressed": String(!choice.hidden.has(renderer.name)), title: `Show or hide ${renderer.name}`,
      onclick: () => {
        if (!choice.hidden.delete(renderer.name)) choice.hidden.add(renderer.name);
        draw();
        plotsChanged();
      } }, swatch(renderer), renderer.name)));
  };
  draw();
}

function makePlots() {
  const log = byId("metric-log");
  log.checked = choice.metricLog;
  log.addEventListener("change", () => {
    choice.metricLog = log.checked;
    plotsChanged();
  });
  const chooser = select(metricKeys.map((key) => [key, axisName(figures[key])]), choice.metric, (key) => {
    choice.metric = key;
    choice.metricLog = log.checked = Boolean(figures[key].log);
    plotsChanged();
  });
  chooser.id = "metric";
  byId("metric").replaceWith(chooser);
  makeLegend();
  makePlot(byId("plot-time"), 0);
  makePlot(byId("plot-bytes"), 1);
  plots.forEach(drawPlot);
  addEventListener("resize", () => plots.filter((plot) => plot.width !== plotWidth(plot)).forEach(drawPlot));
}
