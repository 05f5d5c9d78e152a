// SPDX-License-Identifier: Apache-2.0
// Flipping between pictures in one place, with one pan and zoom for all of them. Without a script they stand one below the other.
"use strict";

function viewer(figure) {
  const stage = figure.querySelector(".stage");
  const pictures = [...stage.querySelectorAll("img")];
  const buttons = [...figure.querySelectorAll("button")];
  let shown = 0, run = "0"; // what is shown; the run that was shown last, whose difference `d` shows and whose reference `r`
  let zoom = 1, x = 0, y = 0; // of the pictures, x and y in pixels of the page

  function show(index) {
    shown = (index + pictures.length) % pictures.length;
    if (pictures[shown].dataset.run) run = pictures[shown].dataset.run;
    pictures.forEach((picture, i) => picture.classList.toggle("shown", i === shown));
    buttons.forEach((button, i) => button.setAttribute("aria-pressed", i === shown));
  }

  // The picture always covers the stage.
  function place() {
    x = Math.min(0, Math.max(stage.clientWidth * (1 - zoom), x));
    y = Math.min(0, Math.max(stage.clientHeight * (1 - zoom), y));
    stage.style.setProperty("--x", x + "px");
    stage.style.setProperty("--y", y + "px");
    stage.style.setProperty("--zoom", zoom);
    stage.classList.toggle("near", zoom * stage.clientWidth >= 2 * pictures[0].naturalWidth);
  }

  function zoomAt(factor, atX, atY) {
    const next = Math.min(64, Math.max(1, zoom * factor));
    x = atX - (atX - x) * next / zoom;
    y = atY - (atY - y) * next / zoom;
    zoom = next;
    place();
  }

  // Of the pictures of a kind the one of the run; where there is none, or it is a reference and shown already, the next one.
  function showKind(kind) {
    const matches = pictures.map((picture, i) => i).filter(i => pictures[i].dataset.kind === kind);
    if (!matches.length) return;
    const ofRun = matches.find(i => (pictures[i].dataset.run ?? pictures[i].dataset.runs).split(" ").includes(run));
    const isWanted = ofRun !== undefined && (kind === "difference" || ofRun !== shown);
    show(isWanted ? ofRun : matches.find(i => i > shown) ?? matches[0]);
  }

  figure.keys = {
    ArrowLeft: () => show(shown - 1),
    ArrowRight: () => show(shown + 1),
    r: () => showKind("reference"),
    d: () => showKind("difference"),
    "0": () => { zoom = 1; place(); },
  };
  pictures.forEach((picture, i) => {
    if (picture.dataset.kind === "run") figure.keys[Number(picture.dataset.run) + 1] = () => show(i);
  });
  buttons.forEach((button, i) => button.addEventListener("click", () => show(i)));
  stage.addEventListener("wheel", event => {
    event.preventDefault();
    const box = stage.getBoundingClientRect();
    zoomAt(Math.exp(-event.deltaY / 300), event.clientX - box.left, event.clientY - box.top);
  }, { passive: false });
  stage.addEventListener("pointerdown", event => {
    stage.setPointerCapture(event.pointerId);
    stage.classList.add("held");
  });
  stage.addEventListener("pointermove", event => {
    if (!stage.hasPointerCapture(event.pointerId)) return;
    x += event.movementX;
    y += event.movementY;
    place();
  });
  stage.addEventListener("pointerup", () => stage.classList.remove("held"));
  stage.addEventListener("dragstart", event => event.preventDefault());
  stage.addEventListener("dblclick", () => { zoom = 1; place(); });
  figure.classList.add("flips");
  show(0);
  pictures[0].decode().then(place);
}

const viewers = [...document.querySelectorAll(".viewer")];
viewers.forEach(viewer);
let active = viewers[0]; // the one that keys go to
viewers.forEach(figure => figure.addEventListener("pointerenter", () => { active = figure; }));
document.addEventListener("keydown", event => {
  const key = active?.keys[event.key];
  if (!key || event.ctrlKey || event.altKey || event.metaKey || event.target.tagName === "INPUT") return;
  event.preventDefault();
  key();
});
