// The summary as a plot: each renderer's mean ratio against its median frame time or its bytes, and the Pareto fronts of
// the two: of all renderers, and of those of a kind.

const baselines = ["full-1spp", "full-4spp"];
const frontCosts = {
  time: { figure: figures.frameMs, value: "medianFrameMs", front: "onParetoFront", kindFront: "onKindFront" },
  bytes: { figure: figures.bytesRead, value: "medianBytesRead", front: "onBytesFront", kindFront: "onKindBytesFront" },
};

// best, kindBest: whether it lies on the fronts.
function frontPoints(cost) {
  return renderers.filter((renderer) => report.summary[renderer.name]).map((renderer) => {
    const summary = report.summary[renderer.name];
    return { renderer, label: renderer.label, ...summary, cost: summary[cost.value], best: summary[cost.front],
      kindBest: summary[cost.kindFront] };
  }).filter((point) => point.ratioToFull1spp !== null);
}

// From one point of a front to the next: as the least error that so much buys.
function frontLine(front, right, attributes) {
  front.sort((a, b) => a.px - b.px || b.py - a.py);
  const path = front.map(({ px, py }, i) => `${i ? "H" : "M"}${px.toFixed(1)}${i ? "V" : ","}${py.toFixed(1)}`);
  return shape("path", { ...attributes, d: `${path.join("")}H${right}` });
}

// Of kinds with several points.
function kindLines(points, right) {
  const kinds = [...new Set(points.map((point) => point.renderer.base))];
  return kinds.map((kind) => points.filter((point) => point.renderer.base === kind && point.kindBest))
    .filter((front) => front.length > 1)
    .map((front) => frontLine(front, right, { class: "kind-front", style: `stroke:${front[0].renderer.colour}` }));
}

function frontMark(point) {
  const baseline = baselines.includes(point.renderer.name);
  const told = `${point.renderer.name}: ratio ${fixed(3)(point.ratioToFull1spp)}, ` +
    `worst ${fixed(3)(point.worstRatio)}, worst holes ${percent(point.worstHoleRate)} %, ${figure(point.medianFrameMs)} ms, ` +
    `${bytes(point.medianBytesRead)}, ${whole(point.medianTriangles)} triangles${point.best ? ", on the front" : ""}`;
  const mark = markShape(point, point.best ? "dot best" : "dot", point.best ? 6.5 : 4.5);
  mark.append(shape("title", {}, told));
  if (!baseline) return mark;
  return shape("g", {}, shape("circle", { class: "baseline", cx: point.px, cy: point.py, r: 10 }), mark);
}

function drawFront(plot) {
  const cost = frontCosts[plot.cost], points = frontPoints(cost), ratio = figures.ratioToFull1spp;
  plot.width = plotWidth(plot);
  plot.height = Math.round(Math.min(520, Math.max(340, plot.width * 0.5)));
  plot.svg.replaceChildren();
  fill(plot.svg, { viewBox: `0 0 ${plot.width} ${plot.height}`, width: plot.width, height: plot.height }, []);
  if (!points.length) {
    plot.svg.append(shape("text", { x: plot.width / 2, y: plot.height / 2, class: "title x" }, "No ratio to show"));
    return;
  }
  const right = plot.width - margin.right;
  const xScale = makeScale(points.map((point) => point.cost), true, margin.left, right, 56);
  const yScale = makeScale([...points.map((point) => point.ratioToFull1spp), ratio.line], true,
    plot.height - margin.bottom, margin.top, 30);
  for (const point of points) {
    point.px = xScale.at(point.cost);
    point.py = yScale.at(point.ratioToFull1spp);
  }
  const first = (point) => (point.best ? 0 : baselines.includes(point.renderer.name) ? 1 : 2);
  plot.svg.append(axisShapes(plot, xScale, yScale, cost.figure, ratio), ...kindLines(points, right),
    frontLine(points.filter((point) => point.best), right, { class: "front" }),
    shape("g", {}, ...points.map(frontMark)),
    shape("g", {}, ...makeLabels(plot, points.sort((a, b) => first(a) - first(b)), 6)));
}

function makeFront() {
  const plot = { figure: byId("front"), cost: "time", svg: shape("svg", { role: "img", "aria-label": "Pareto front" }) };
  const families = [...new Map(renderers.map((renderer) => [renderer.base, renderer])).values()];
  const chooser = select(Object.entries(frontCosts).map(([key, cost]) => [key, axisName(cost.figure)]), plot.cost, (key) => {
    plot.cost = key;
    drawFront(plot);
  });
  plot.figure.append(element("figcaption", {}, element("label", {}, "against ", chooser), ...families.map((renderer) =>
    element("span", { class: "renderer" }, swatch(renderer), renderer.base))), plot.svg);
  drawFront(plot);
  addEventListener("resize", () => plot.width !== plotWidth(plot) && drawFront(plot));
}
