// The report as the page sees it: cameras, renderers with a look of their own, figures with names, and what is chosen.

const report = JSON.parse(byId("data").textContent);

// read: of an entry; format: with digits for a table; tick: for an axis.
const figures = {
  paperError: { name: "Error", log: true,
    text: "Sum of |ΔR| + |ΔG| + |ΔB| (0–255) over the image, divided by the pixels of the reference's bounding " +
      "rectangle: the figure of Saraiva, Oliveira, Madeiras Pereira (WSCG 2010)." },
  ratioToFull1spp: { name: "Ratio", log: true, line: 1, format: fixed(3),
    long: "Error ÷ error of full geometry, 1 sample",
    text: "The error divided by that of full geometry at one sample a pixel from the same camera. None where " +
      "that has no error." },
  flip: { name: "FLIP", log: true, format: fixed(4),
    text: "Andersson et al. 2020: what a person sees when the two pictures take turns, 0 to 1, mean over the " +
      "image, at {ppd} pixels per degree." },
  psnr: { name: "PSNR", unit: "dB", higher: true, format: fixed(2),
    text: "From the mean square difference over the foreground; equal pictures are given {cap} dB." },
  ssim: { name: "SSIM", higher: true, format: fixed(4),
    text: "Wang et al. 2004, Gaussian window of 11 × 11 pixels on luma, mean over the foreground." },
  mae: { name: "MAE", log: true, text: "Mean absolute difference (0–255) over the foreground's pixels and channels." },
  p95: { name: "p95", format: fixed(0), text: "95th percentile of max(|ΔR|, |ΔG|, |ΔB|) over the foreground." },
  p99: { name: "p99", format: fixed(0), text: "99th percentile of the same." },
  holeRate: { name: "Holes", unit: "%", format: percent, scale: 100,
    text: "Of the pixels that the reference covers wholly, the share that is covered by less than half." },
  leakRate: { name: "Leaks", unit: "%", format: percent, scale: 100,
    text: "Pixels drawn where the reference is empty, per pixel of the foreground." },
  coverageBias: { name: "Coverage", unit: "%", format: percent, scale: 100,
    text: "Covered area relative to the reference's, minus 1." },
  silhouetteShare: { name: "Silhouette", unit: "%", format: percent, scale: 100,
    text: "The part of the error that lies on pixels the reference covers partly." },
  impostorShare: { name: "Impostors", unit: "%", format: percent, scale: 100,
    text: "How much of what is drawn over the foreground comes from impostors." },
  frameMs: { name: "Frame", unit: "ms", log: true, long: "Frame, median", read: (entry) => entry.frameMs.median,
    text: "Wall time of a warm frame, median of the timed ones." },
  frameP95: { name: "Frame p95", unit: "ms", log: true, read: (entry) => entry.frameMs.p95,
    text: "95th percentile of the same." },
  cpuMs: { name: "CPU", unit: "ms", log: true, long: "CPU time of a frame",
    text: "Processor time of the whole process in a warm frame, median." },
  bytesRead: { name: "Read", log: true, long: "Bytes read by the first frame", format: bytes, tick: bytes,
    text: "What the first frame read of the pack, when nothing was in memory." },
  triangles: { name: "Triangles", log: true, long: "Triangles drawn", format: whole, tick: short,
    text: "Drawn in a frame." },
  meshes: { name: "Meshes", log: true, long: "Cells drawn as simplified meshes", format: whole, tick: short,
    text: "Inner cells drawn as their simplified meshes." },
  impostors: { name: "Cells", log: true, long: "Cells drawn as impostors", format: whole, tick: short,
    text: "Drawn as impostors." },
  texels: { name: "Texels", log: true, long: "Texels of the views drawn", format: whole, tick: short,
    text: "Of the views drawn, cropped." },
  diameters: { name: "Distance", unit: "diameters", long: "Distance of the eye",
    text: "Of the eye from the surface of the bounding sphere, in its diameters; negative inside." },
};
for (const [key, item] of Object.entries(figures)) {
  item.key = key;
  item.read ??= (entry) => entry[key];
  item.format ??= figure;
  item.tick ??= (value) => String(Number(value.toPrecision(3)));
  item.scale ??= 1;
  item.text = item.text.replace("{ppd}", report.flipPixelsPerDegree).replace("{cap}", report.psnrCap);
}
const metricKeys = ["paperError", "ratioToFull1spp", "flip", "psnr", "ssim", "mae", "p99", "holeRate"];
const costKeys = ["frameMs", "cpuMs", "bytesRead", "triangles", "meshes", "texels", "impostors", "diameters"];
const tableKeys = Object.keys(figures);

const axisName = (item) => (item.long || item.name) + (item.unit ? `, ${item.unit}` : "");
const figureText = (item, entry) => {
  const text = item.format(item.read(entry));
  return item.unit && text !== missing ? `${text} ${item.unit}` : text;
};

const entries = report.entries;
const paths = report.paths ?? [];

// Order of first occurrence; the stem of a camera's files is its identity.
const cameras = [...new Map(entries.map((entry) => [entry.stem, { stem: entry.stem, name: entry.camera }])).values()];

// A class has a mark of its own and a family of colours (style.css), in order. The variants of a sweep, as
// "auto@texel-pixels=0.5@triangle-budget=2M", share the colour of their kind; their values tell them apart.
const marks = { geometry: "circle", impostor: "square", mixed: "diamond" };
const renderers = [];
for (const entry of [...entries, ...paths.flatMap((path) => path.renderers)]) {
  if (renderers.some((renderer) => renderer.name === entry.renderer)) continue;
  const family = marks[entry.class] ? entry.class : "mixed";
  const base = entry.kind && entry.renderer.startsWith(entry.kind) ? entry.kind : entry.renderer;
  const swept = entry.renderer.slice(base.length).split("@").filter(Boolean);
  const others = new Set(renderers.filter((renderer) => renderer.family === family).map((renderer) => renderer.base));
  const place = (others.has(base) ? [...others].indexOf(base) : others.size) % 5;
  renderers.push({ name: entry.renderer, base, family, mark: marks[family], colour: `var(--${family}-${place})`,
    label: swept.map((setting) => setting.slice(setting.indexOf("=") + 1)).join(" · ") || base,
    settings: entry.settings });
}
const rendererOf = (entry) => renderers.find((renderer) => renderer.name === entry.renderer);
const entryOf = (stem, renderer) => entries.find((entry) => entry.stem === stem && entry.renderer === renderer);

function markPath(mark, radius) {
  const r = radius;
  if (mark === "square") return `M${-r * 0.9},${-r * 0.9}h${r * 1.8}v${r * 1.8}h${-r * 1.8}z`;
  if (mark === "diamond") return `M0,${-r * 1.25}L${r * 1.25},0L0,${r * 1.25}L${-r * 1.25},0z`;
  return `M${-r},0a${r},${r} 0 1,0 ${2 * r},0a${r},${r} 0 1,0 ${-2 * r},0z`;
}

function swatch(renderer) {
  return shape("svg", { class: "swatch", viewBox: "-7 -7 14 14", "aria-hidden": "true" },
    shape("path", { d: markPath(renderer.mark, 5), style: `fill:${renderer.colour}` }));
}

// What is chosen. The address keeps it (#y=flip&x1=cpuMs...), so that a view of the report can be passed on.
const modes = ["picture", "difference", "flip"];
const sides = ["reference", ...renderers.map((renderer) => renderer.name)];
const choice = {
  metric: "paperError",
  metricLog: true,
  costs: ["frameMs", "bytesRead"],
  hidden: new Set(),
  camera: cameras.length ? cameras[0].stem : "",
  left: "reference",
  right: sides.find((name) => name.split("@")[0] === "auto") ?? sides[sides.length - 1],
  mode: "picture",
};

function readAddress() {
  const known = (text, allowed, otherwise) => (allowed.includes(text) ? text : otherwise);
  const given = new URLSearchParams(location.hash.slice(1));
  choice.metric = known(given.get("y"), metricKeys, choice.metric);
  choice.metricLog = given.has("log") ? given.get("log") === "1" : Boolean(figures[choice.metric].log);
  choice.costs = ["x1", "x2"].map((name, i) => known(given.get(name), costKeys, choice.costs[i]));
  choice.hidden = new Set((given.get("off") || "").split(",").filter((name) => sides.includes(name)));
  choice.camera = known(given.get("camera"), cameras.map((camera) => camera.stem), choice.camera);
  choice.left = known(given.get("left"), sides, choice.left);
  choice.right = known(given.get("right"), sides, choice.right);
  choice.mode = known(given.get("mode"), modes, choice.mode);
}

function writeAddress() {
  const given = new URLSearchParams({ y: choice.metric, log: choice.metricLog ? "1" : "0", x1: choice.costs[0],
    x2: choice.costs[1], camera: choice.camera, left: choice.left, right: choice.right, mode: choice.mode });
  if (choice.hidden.size) given.set("off", [...choice.hidden].join(","));
  location.replace(`#${given}`);
}
