// Two pictures of one camera over each other with a slider between them, and all of them side by side below.

const view = { split: 0.5, zoom: 1, x: 0, y: 0 };  // x, y: shift in pixels of the viewer
const viewer = {};

// Stems and names of renderers are made by the program that wrote the files, without quotes or slashes.
function pictureFile(side, mode) {
  const end = side === "reference" ? "reference" : mode === "picture" ? side : `${side}.${mode}`;
  return `${encodeURIComponent(choice.camera)}.${encodeURIComponent(end)}.png`;
}

function picture(side, mode, attributes) {
  const node = element("img", { src: pictureFile(side, mode), alt: `${side}, ${mode}`, draggable: "false",
    width: report.size[0], height: report.size[1], ...attributes });
  const file = pictureFile(side, mode);
  node.addEventListener("error", () => node.replaceWith(element("span", { class: "absent" }, `${file} is not there`)));
  return node;
}

function place() {
  const [width, height] = [viewer.frame.clientWidth, viewer.frame.clientHeight];
  const clampShift = (shift, size) => Math.min(0, Math.max(size * (1 - view.zoom), shift));
  view.x = clampShift(view.x, width);
  view.y = clampShift(view.y, height);
  for (const layer of [viewer.left, viewer.right])
    layer.firstChild.style.transform = `translate(${view.x}px,${view.y}px) scale(${view.zoom})`;
  viewer.frame.classList.toggle("pixels", view.zoom >= 2);
  viewer.right.style.clipPath = `inset(0 0 0 ${100 * view.split}%)`;
  viewer.handle.style.left = `${100 * view.split}%`;
  viewer.range.value = String(Math.round(1000 * view.split));
  viewer.scale.textContent = `${view.zoom} ×`;
}

function zoomTo(zoom) {
  const [cx, cy] = [viewer.frame.clientWidth / 2, viewer.frame.clientHeight / 2], by = zoom / view.zoom;
  Object.assign(view, { zoom, x: cx - (cx - view.x) * by, y: cy - (cy - view.y) * by });
  place();
}

// Near the handle a drag moves the slider; elsewhere, where the picture is enlarged, the picture.
function startDrag(event) {
  const box = viewer.frame.getBoundingClientRect(), start = { x: event.clientX - view.x, y: event.clientY - view.y };
  const slide = view.zoom === 1 || Math.abs(event.clientX - box.left - view.split * box.width) < 24;
  const move = (now) => {
    if (slide) view.split = Math.min(1, Math.max(0, (now.clientX - box.left) / box.width));
    else Object.assign(view, { x: now.clientX - start.x, y: now.clientY - start.y });
    place();
  };
  viewer.frame.setPointerCapture(event.pointerId);
  viewer.frame.addEventListener("pointermove", move);
  for (const end of ["pointerup", "pointercancel"])
    viewer.frame.addEventListener(end, () => viewer.frame.removeEventListener("pointermove", move), { once: true });
  move(event);
}

function sideCaption(side) {
  const entry = entryOf(choice.camera, side);
  if (!entry) return [element("b", {}, side), ` ${report.reference.samples} samples a pixel`];
  const keys = ["paperError", "ratioToFull1spp", "flip", "psnr", "ssim", "frameMs"];
  return [element("b", {}, swatch(rendererOf(entry)), side), ...keys.map((key) =>
    element("span", {}, `${figures[key].name} `, element("i", {}, figureText(figures[key], entry))))];
}

function strip() {
  return sides.map((side) => {
    const entry = entryOf(choice.camera, side);
    const chosen = side === choice.right ? "right" : side === choice.left ? "left" : null;
    return element("button", { type: "button", class: "thumbnail", "data-chosen": chosen, onclick: () => {
      choice.right = side;
      picturesChanged();
    } }, picture(side, choice.mode, { loading: "lazy" }), element("span", { class: "caption" },
      element("b", {}, ...(entry ? [swatch(rendererOf(entry))] : []), side),
      entry ? ["paperError", "flip"].map((key) => `${figures[key].name} ${figureText(figures[key], entry)}`).join(" · ")
        : "the truth"));
  });
}

function drawPictures() {
  viewer.left.replaceChildren(picture(choice.left, choice.mode));
  viewer.right.replaceChildren(picture(choice.right, choice.mode));
  viewer.leftCaption.replaceChildren(...sideCaption(choice.left));
  viewer.rightCaption.replaceChildren(...sideCaption(choice.right));
  viewer.cameras.value = choice.camera;
  viewer.lefts.value = choice.left;
  viewer.rights.value = choice.right;
  for (const button of viewer.modes.children) button.setAttribute("aria-pressed", String(button.value === choice.mode));
  viewer.key.hidden = choice.mode === "picture";
  viewer.key.className = `key ${choice.mode}`;
  viewer.key.textContent = choice.mode === "flip" ? "FLIP, 0 to 1" : `|Δ| of R, G, B, ${report.differenceGain} times`;
  byId("strip").replaceChildren(...strip());
  place();
}

function stepCamera(by) {
  const index = cameras.findIndex((camera) => camera.stem === choice.camera);
  choice.camera = cameras[(index + by + cameras.length) % cameras.length].stem;
  picturesChanged();
}

// From a plot or the table.
function showPictures(entry) {
  choice.camera = entry.stem;
  choice.right = entry.renderer;
  picturesChanged();
  byId("pictures-heading").scrollIntoView({ behavior: "smooth" });
}

function makeFrame() {
  viewer.left = element("div", { class: "layer" });
  viewer.right = element("div", { class: "layer" });
  viewer.handle = element("div", { class: "handle" });
  viewer.frame = element("div", { class: "frame", style: `aspect-ratio:${report.size[0]}/${report.size[1]}`,
    onpointerdown: startDrag }, viewer.left, viewer.right, viewer.handle);
  viewer.range = element("input", { type: "range", min: "0", max: "1000", "aria-label": "Slider between left and right",
    oninput: () => {
      view.split = viewer.range.value / 1000;
      place();
    } });
  viewer.key = element("div", { class: "key" });
  viewer.leftCaption = element("p");
  viewer.rightCaption = element("p");
  byId("viewer").append(viewer.frame, viewer.range, viewer.key,
    element("div", { class: "captions" }, viewer.leftCaption, viewer.rightCaption));
  addEventListener("resize", place);
}

// A chooser of choice[name].
const pictureSelect = (name, choices) => select(choices, choice[name], (value) => {
  choice[name] = value;
  picturesChanged();
});

const iconButton = (text, label, onclick) =>
  element("button", { type: "button", "aria-label": label, title: label, onclick }, text);

function makePictureControls() {
  viewer.cameras = pictureSelect("camera", cameras.map((camera) => [camera.stem, camera.name || "(no name)"]));
  viewer.lefts = pictureSelect("left", sides.map((side) => [side, side]));
  viewer.rights = pictureSelect("right", sides.map((side) => [side, side]));
  const swap = iconButton("⇄", "Swap left and right", () => {
    [choice.left, choice.right] = [choice.right, choice.left];
    picturesChanged();
  });
  const modeButton = ([value, text]) => element("button", { type: "button", value, onclick: () => {
    choice.mode = value;
    picturesChanged();
  } }, text);
  viewer.modes = element("span", { class: "buttons" },
    ...[["picture", "Picture"], ["difference", "Difference"], ["flip", "FLIP"]].map(modeButton));
  viewer.scale = element("span", { class: "scale" });
  const group = (...children) => element("span", { class: "group" }, ...children);
  byId("picture-controls").append(
    group(element("label", {}, "Camera ", viewer.cameras), iconButton("‹", "Previous camera", () => stepCamera(-1)),
      iconButton("›", "Next camera", () => stepCamera(1))),
    group(element("label", {}, "Left ", viewer.lefts), swap, element("label", {}, "Right ", viewer.rights)),
    viewer.modes,
    group(iconButton("−", "Smaller", () => zoomTo(Math.max(1, view.zoom / 2))), viewer.scale,
      iconButton("+", "Larger", () => zoomTo(Math.min(16, view.zoom * 2)))));
}

function makePictures() {
  makePictureControls();
  makeFrame();
  drawPictures();
}
