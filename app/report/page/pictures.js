// SPDX-License-Identifier: Apache-2.0
// "Pictures": a viewer for each name and size. It flips between its pictures in one place, with one pan and zoom for all of them.
"use strict";

function pictureName({ kind, runs, from }, pictures) {
  if (kind === "run") return data.runs[runs[0]].label;
  if (kind === "difference") return `${runs[0] + 1} − ${from === null ? "reference" : from + 1}`;
  return pictures.filter(other => other.kind === kind).length > 1 ? `reference of ${runs.map(run => run + 1).join(", ")}` : "reference";
}

function colourBar(scale) {
  const bar = element("i");
  bar.style.background = `linear-gradient(to right, ${data.colours.map(rgb => `rgb(${rgb})`).join(", ")})`;
  return element("div.scale", "difference: 0", bar, `${threeFigures(scale)} CIELAB units and more`);
}

function viewer({ name, width, height, scale, pictures }) {
  const stage = element("div.stage"), buttons = element("div.buttons"), keys = {};
  stage.style.setProperty("--aspect", width / height);
  stage.style.setProperty("--width", width * Math.max(1, Math.floor(640 / width)) + "px"); // small ones several times as large
  const images = pictures.map((picture, i) => {
    const text = pictureName(picture, pictures), image = element("img"), button = element("button");
    const key = { run: String(picture.runs[0] + 1), reference: "r", difference: "d" }[picture.kind];
    image.alt = text;
    image.src = "data:image/png;base64," + picture.png;
    button.append(element("kbd", key), text);
    button.addEventListener("click", () => show(i));
    if (picture.kind === "run") keys[key] = () => show(i);
    stage.append(image);
    buttons.append(button);
    return image;
  });
  // What is shown; the run that was shown last, whose difference `d` shows and whose reference `r`.
  let shown = 0, run = pictures[0].runs[0];
  let zoom = 1, x = 0, y = 0; // where the pictures are, x and y in pixels of the page

  function show(index) {
    shown = (index + images.length) % images.length;
    if (pictures[shown].kind !== "reference") run = pictures[shown].runs[0];
    images.forEach((image, i) => image.classList.toggle("shown", i === shown));
    [...buttons.children].forEach((button, i) => button.setAttribute("aria-pressed", i === shown));
  }
  // The picture always covers the stage.
  function place(factor = 1, atX = 0, atY = 0) {
    const next = Math.min(64, Math.max(1, zoom * factor));
    x = Math.min(0, Math.max(stage.clientWidth * (1 - next), atX - (atX - x) * next / zoom));
    y = Math.min(0, Math.max(stage.clientHeight * (1 - next), atY - (atY - y) * next / zoom));
    zoom = next;
    for (const image of images) image.style.transform = `translate(${x}px, ${y}px) scale(${zoom})`;
    stage.classList.toggle("near", zoom * stage.clientWidth >= 2 * width);
  }
  // Shows the run's picture of a kind; where there is none, or it is a reference and shown already, the next one.
  function showKind(kind) {
    const matches = [...pictures.keys()].filter(i => pictures[i].kind === kind), ofRun = matches.find(i => pictures[i].runs.includes(run));
    if (!matches.length) return;
    show(ofRun !== undefined && (kind === "difference" || ofRun !== shown) ? ofRun : matches.find(i => i > shown) ?? matches[0]);
  }
  Object.assign(keys, { ArrowLeft: () => show(shown - 1), ArrowRight: () => show(shown + 1), r: () => showKind("reference"),
    d: () => showKind("difference"), 0: () => place(0) });
  stage.addEventListener("wheel", event => {
    event.preventDefault();
    const box = stage.getBoundingClientRect();
    place(Math.exp(-event.deltaY / 300), event.clientX - box.left, event.clientY - box.top);
  }, { passive: false });
  stage.addEventListener("pointerdown", event => stage.setPointerCapture(event.pointerId));
  stage.addEventListener("pointermove", event => {
    if (!stage.hasPointerCapture(event.pointerId)) return;
    x += event.movementX;
    y += event.movementY;
    place();
  });
  stage.addEventListener("dragstart", event => event.preventDefault());
  stage.addEventListener("dblclick", keys[0]);
  addEventListener("load", () => { show(0); place(); });

  const made = element("figure", data.pictures.some(other => other.name !== name) ? element("h3", name) : null, stage, buttons,
    scale > 0 ? colourBar(scale) : null, element("figcaption", `${width} × ${height} pixels, at full size; runs and references as ` +
      "image.png shows them. Wheel: zoom; drag: pan; ", element("kbd", "←"), " ", element("kbd", "→"), ": flip; ", element("kbd", "d"),
      ": the shown run's difference; ", element("kbd", "0"), ": the whole picture."));
  made.addEventListener("pointerenter", () => { activeKeys = keys; });
  activeKeys ??= keys;
  return made;
}

let activeKeys = null; // the viewer's that keys go to
document.addEventListener("keydown", event => {
  const act = activeKeys?.[event.key];
  if (!act || event.ctrlKey || event.altKey || event.metaKey) return;
  event.preventDefault();
  act();
});

/// Every run's picture with what it is called, as long as there are several of one size.
function picturesSideBySide() {
  const pictures = data.pictures.length ? data.pictures[0].pictures.filter(({ kind }) => kind === "run") : [];
  if (pictures.length < 2) return [];
  const grid = element("div.side");
  grid.style.setProperty("--across", Math.min(pictures.length, 4));
  grid.append(...pictures.map(({ runs, png }) => {
    const image = element("img");
    image.alt = data.runs[runs[0]].label;
    image.src = "data:image/png;base64," + png;
    return element("figure", image, element("figcaption", ...runName(runs[0])));
  }));
  return [grid];
}

function pictureViewers() {
  const names = data.pictures.map(group => group.name);
  return [data.pictures.length ? null : element("p", "No run has its picture any more."),
    new Set(names).size < names.length ? element("p", "The runs are of different sizes: those of one size can be compared.") : null,
    ...data.pictures.map(viewer)];
}
