// Names beside marks, where there is room.

// Boxes around a mark, the nearest first: beside it, above and below, then farther away and aslant. Of points of a front
// that falls to the right, first on the side where no other mark can be.
function labelPlaces({ px, py, best }, width, height, rings) {
  const straight = best ? [[-1, 0], [0, 1], [1, 0], [0, -1]] : [[1, 0], [-1, 0], [0, -1], [0, 1]];
  const aslant = [[-0.8, 0.6], [0.8, -0.6], [0.8, 0.6], [-0.8, -0.6]];
  const start = (at, direction, size) => at - size * (direction > 0 ? 0 : direction < 0 ? 1 : 0.5);
  const places = [];
  for (let ring = 0; ring < rings; ++ring) {
    const distance = 9 + 14 * ring;
    for (const [dx, dy] of ring ? [...aslant, ...straight] : straight)
      places.push({ x: start(px + dx * distance, dx, width), y: start(py + dy * distance, dy, height), width,
        height, ring });
  }
  return places;
}

const overlap = (a, b) => a.x <= b.x + b.width && b.x <= a.x + a.width && a.y <= b.y + b.height &&
  b.y <= a.y + a.height;

// points: { px, py, label, renderer }, the most important first. rings: how far from its mark a name may stand; one that
// is not next to it gets a line to it. Names without room are left out.
function makeLabels(plot, points, rings) {
  const taken = points.map(({ px, py }) => ({ x: px - 7, y: py - 7, width: 14, height: 14 }));
  const inside = (box) => box.x > margin.left && box.x + box.width < plot.width - 4 && box.y > margin.top - 8 &&
    box.y + box.height < plot.height - margin.bottom;
  const shapes = [];
  for (const point of points) {
    const box = labelPlaces(point, 7 * point.label.length + 4, 14, rings)
      .find((place) => inside(place) && !taken.some((other) => overlap(place, other)));
    if (!box) continue;
    taken.push(box);
    const colour = point.renderer.colour;
    if (box.ring)
      shapes.unshift(shape("line", { x1: point.px, y1: point.py, class: "leader", style: `stroke:${colour}`,
        x2: Math.min(Math.max(point.px, box.x), box.x + box.width),
        y2: Math.min(Math.max(point.py, box.y), box.y + box.height) }));
    shapes.push(shape("text", { x: box.x + 2, y: box.y + 11, class: "name", style: `fill:${colour}` }, point.label));
  }
  return shapes;
}
