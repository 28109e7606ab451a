// The summary as a plot: each renderer's mean ratio against its median frame time, and the Pareto front of the two.

const baselines = ["full-1spp", "full-4spp"];

function frontPoints() {
  return renderers.map((renderer) => ({ renderer, label: renderer.label, ...report.summary[renderer.name] }))
    .filter((point) => point.ratioToFull1spp !== null);
}

// From one point of the front to the next: as the least error that so much time buys.
function frontLine(points, right) {
  const front = points.filter((point) => point.onParetoFront).sort((a, b) => a.px - b.px || b.py - a.py);
  const path = front.map(({ px, py }, i) => `${i ? "H" : "M"}${px.toFixed(1)}${i ? "V" : ","}${py.toFixed(1)}`);
  return shape("path", { class: "front", d: `${path.join("")}H${right}` });
}

function frontMark(point) {
  const baseline = baselines.includes(point.renderer.name);
  const told = `${point.renderer.name}: ratio ${fixed(3)(point.ratioToFull1spp)}, ` +
    `worst ${fixed(3)(point.worstRatio)}, worst holes ${percent(point.worstHoleRate)} %, ${figure(point.medianFrameMs)} ms, ` +
    `${whole(point.medianTriangles)} triangles${point.onParetoFront ? ", on the front" : ""}`;
  const mark = markShape(point, point.onParetoFront ? "dot best" : "dot", point.onParetoFront ? 6.5 : 4.5);
  mark.append(shape("title", {}, told));
  if (!baseline) return mark;
  return shape("g", {}, shape("circle", { class: "baseline", cx: point.px, cy: point.py, r: 10 }), mark);
}

function drawFront(plot) {
  const points = frontPoints(), time = figures.frameMs, ratio = figures.ratioToFull1spp;
  plot.width = plotWidth(plot);
  plot.height = Math.round(Math.min(520, Math.max(340, plot.width * 0.5)));
  plot.svg.replaceChildren();
  fill(plot.svg, { viewBox: `0 0 ${plot.width} ${plot.height}`, width: plot.width, height: plot.height }, []);
  if (!points.length) {
    plot.svg.append(shape("text", { x: plot.width / 2, y: plot.height / 2, class: "title x" }, "No ratio to show"));
    return;
  }
  const right = plot.width - margin.right;
  const xScale = makeScale(points.map((point) => point.medianFrameMs), true, margin.left, right, 56);
  const yScale = makeScale([...points.map((point) => point.ratioToFull1spp), ratio.line], true,
    plot.height - margin.bottom, margin.top, 30);
  for (const point of points) {
    point.px = xScale.at(point.medianFrameMs);
    point.py = yScale.at(point.ratioToFull1spp);
  }
  const first = (point) => (point.onParetoFront ? 0 : baselines.includes(point.renderer.name) ? 1 : 2);
  plot.svg.append(axisShapes(plot, xScale, yScale, time, ratio), frontLine(points, right),
    shape("g", {}, ...points.map(frontMark)),
    shape("g", {}, ...makeLabels(plot, points.sort((a, b) => first(a) - first(b)), 6)));
}

function makeFront() {
  const plot = { figure: byId("front"), svg: shape("svg", { role: "img", "aria-label": "Pareto front" }) };
  const families = [...new Map(renderers.map((renderer) => [renderer.base, renderer])).values()];
  plot.figure.append(element("figcaption", {}, ...families.map((renderer) =>
    element("span", { class: "renderer" }, swatch(renderer), renderer.base))), plot.svg);
  drawFront(plot);
  addEventListener("resize", () => plot.width !== plotWidth(plot) && drawFront(plot));
}
