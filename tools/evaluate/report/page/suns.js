// The cameras again under other suns: a line a sun, a column a renderer.

function makeSuns() {
  const suns = report.suns ?? [];
  byId("suns").hidden = !suns.length;
  if (!suns.length) return;
  const degrees = (title, hint, key) => ({ title, hint, numeric: true, value: (row) => row[key], text: (row) => row[key].toFixed(1) });
  const names = renderers.map((renderer) => renderer.name).filter((name) => suns.some((sun) => sun.renderers[name]));
  const ratioOf = (row, name) => row.renderers[name]?.ratioToFull1spp ?? null;
  makeTable(byId("suns-table"), [
    degrees("Azimuth, °", "Around the up axis", "azimuthDeg"), degrees("Elevation, °", "Above the horizon", "elevationDeg"),
    ...names.map((name) => ({ title: name, numeric: true, value: (row) => ratioOf(row, name),
      hint: "Geometric mean over the cameras of its error over that of full geometry at one sample under the same sun",
      text: (row) => fixed(3)(ratioOf(row, name)) })),
  ], suns);
}
