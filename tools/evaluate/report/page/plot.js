// A scatter plot of one error against one cost: a mark for each entry, a large one for each renderer's median.

const plots = [];
const margin = { left: 54, right: 18, top: 26, bottom: 44 };
const visible = (entry) => !choice.hidden.has(entry.renderer);
const metric = () => figures[choice.metric];

function median(values) {
  const sorted = [...values].sort((a, b) => a - b), middle = sorted.length >> 1;
  return sorted.length % 2 ? sorted[middle] : (sorted[middle - 1] + sorted[middle]) / 2;
}

// What a plot draws: entries that have both values, and how many have not.
function plotData(cost) {
  const points = [];
  let missingCount = 0;
  for (const entry of entries.filter(visible)) {
    const x = cost.read(entry), y = metric().read(entry);
    if (x === null || y === null) ++missingCount;
    else points.push({ entry, x: x * cost.scale, y: y * metric().scale, renderer: rendererOf(entry) });
  }
  const medians = [];
  for (const renderer of renderers) {
    const own = points.filter((point) => point.renderer === renderer);
    if (own.length)
      medians.push({ renderer, label: renderer.label, x: median(own.map((point) => point.x)), y: median(own.map((point) => point.y)) });
  }
  return { points, medians, missingCount };
}

function axisShapes(plot, xScale, yScale, cost, error) {
  const { width, height } = plot, bottom = height - margin.bottom, right = width - margin.right;
  const group = shape("g", { class: "axes" });
  const line = (x1, y1, x2, y2, kind) => group.append(shape("line", { x1, y1, x2, y2, class: kind }));
  const text = (x, y, kind, content) => group.append(shape("text", { x, y, class: kind }, content));
  for (const tick of xScale.ticks) {
    const x = xScale.at(tick.value);
    line(x, margin.top, x, bottom, tick.named ? "grid" : "grid minor");
    if (tick.named) text(x, bottom + 16, "tick x", cost.tick(tick.value));
  }
  for (const tick of yScale.ticks) {
    const y = yScale.at(tick.value);
    line(margin.left, y, right, y, tick.named ? "grid" : "grid minor");
    if (tick.named) text(margin.left - 8, y + 4, "tick y", error.tick(tick.value));
  }
  if (xScale.zero) {
    line(xScale.start, margin.top, xScale.start, bottom, "break");
    text(xScale.at(0), bottom + 16, "tick x", "0");
  }
  if (yScale.zero) {
    line(margin.left, yScale.start, right, yScale.start, "break");
    text(margin.left - 8, yScale.at(0) + 4, "tick y", "0");
  }
  if (error.line) line(margin.left, yScale.at(error.line), right, yScale.at(error.line), "level");
  line(margin.left, bottom, right, bottom, "axis");
  line(margin.left, margin.top, margin.left, bottom, "axis");
  text((margin.left + right) / 2, height - 8, "title x", axisName(cost));
  text(margin.left - 46, 13, "title", `${axisName(error)} (${error.higher ? "higher" : "lower"} is better)`);
  return group;
}

const markShape = (point, kind, radius) => shape("path", { class: kind, d: markPath(point.renderer.mark, radius),
  transform: `translate(${point.px.toFixed(1)},${point.py.toFixed(1)})`, style: `fill:${point.renderer.colour}` });

// Of the figure's inside: its svg takes the whole of it.
function plotWidth(plot) {
  const style = getComputedStyle(plot.figure);
  return Math.max(260, plot.figure.clientWidth - parseFloat(style.paddingLeft) - parseFloat(style.paddingRight));
}

function drawPlot(plot) {
  const cost = figures[choice.costs[plot.index]];
  plot.width = plotWidth(plot);
  plot.height = Math.round(Math.min(400, Math.max(300, plot.width * 0.62)));
  const data = plotData(cost);
  plot.points = data.points;
  plot.svg.replaceChildren();
  fill(plot.svg, { viewBox: `0 0 ${plot.width} ${plot.height}`, width: plot.width, height: plot.height }, []);
  showReadout(null);
  if (!data.points.length) {
    plot.svg.append(shape("text", { x: plot.width / 2, y: plot.height / 2, class: "title x" }, "No entry to show"));
    return;
  }
  const levels = metric().line ? [metric().line] : [];
  const xScale = makeScale(data.points.map((point) => point.x), plot.log.checked, margin.left,
    plot.width - margin.right, 56);
  const yScale = makeScale([...data.points.map((point) => point.y), ...levels], choice.metricLog,
    plot.height - margin.bottom, margin.top, 30);
  for (const point of [...data.points, ...data.medians]) {
    point.px = xScale.at(point.x);
    point.py = yScale.at(point.y);
  }
  plot.overlay = shape("g", { class: "overlay" });
  plot.svg.append(axisShapes(plot, xScale, yScale, cost, metric()),
    shape("g", {}, ...data.points.map((point) => markShape(point, "point", 3.2))), plot.overlay,
    shape("g", {}, ...data.medians.map((point) => markShape(point, "median", 6.5)), ...makeLabels(plot, data.medians, 1)));
  plot.note.textContent = data.missingCount ? `${data.missingCount} entries have no such value.` : "";
}
