// The page tests itself when opened with ?selftest: all plots drawn, every control does what it says, nothing too wide.
// The verdict stands in <html data-selftest>.
"use strict";

// Whether a canvas shows more than one colour.
function isDrawn(canvas) {
  const {width, height} = canvas;
  if (width === 0 || height === 0) return false;
  const bytes = canvas.getContext("2d").getImageData(0, 0, width, height).data;
  for (let i = 4; i < bytes.length; i += 4) {
    for (let c = 0; c < 4; ++c) if (bytes[i + c] !== bytes[c]) return true;
  }
  return false;
}

function pictureOf(canvas) {
  return canvas.toDataURL();
}

async function testViewer(viewer, check) {
  await viewer.ready;
  const press = (mode) => viewer.buttons.find((button) => button.dataset.mode === mode).click();
  const point = (type, share) => {
    const frame = viewer.canvas.getBoundingClientRect();
    viewer.canvas.dispatchEvent(new PointerEvent(type, {pointerId: 1, bubbles: true,
      clientX: frame.left + share * frame.width, clientY: frame.top + frame.height / 2}));
  };
  check(viewer.state.a !== viewer.state.b, "the viewer opens on one picture twice");
  viewer.canvas.setPointerCapture = () => {};  // no real pointer is there to capture
  press("slider");
  check(isDrawn(viewer.canvas), "the viewer shows nothing");
  const middle = pictureOf(viewer.canvas);
  point("pointerdown", 0.25);
  point("pointermove", 0.2);
  point("pointerup", 0.2);
  check(Math.abs(viewer.state.split - 0.2) < 0.02, "the slider does not follow the pointer");
  check(pictureOf(viewer.canvas) !== middle, "the slider changes nothing");
  check(viewer.readout.textContent.includes("radiance"), "no pixel values under the pointer");
  press("flip");
  const one = pictureOf(viewer.canvas);
  await new Promise((resolve) => setTimeout(resolve, 1.5 * FLIP_PERIOD_MS));
  check(pictureOf(viewer.canvas) !== one, "flip does not flip");
  press("side");
  check(isDrawn(viewer.canvas), "side by side shows nothing");
  if (viewer.pictures.some((picture) => picture.flip)) {
    press("difference");
    check(isDrawn(viewer.canvas), "the FLIP map shows nothing");
  }
  const before = pictureOf(viewer.canvas);
  viewer.zoomBy(4);
  check(pictureOf(viewer.canvas) !== before, "zoom changes nothing");
  viewer.zoomBy(1 / 64);
  press("slider");
}

async function runSelfTest() {
  const problems = [];
  const check = (holds, text) => { if (!holds) problems.push(text); };
  try {
    const charts = [...document.querySelectorAll(".chart canvas")];
    check(charts.length > 0, "there are no plots");
    charts.forEach((canvas) => check(isDrawn(canvas), `plot "${canvas.getAttribute("aria-label")}" is empty`));
    for (const select of document.querySelectorAll("figcaption select")) {
      select.value = select.options[select.options.length - 1].value;
      select.dispatchEvent(new Event("change"));
      check(isDrawn(select.closest("figure").querySelector("canvas")), "a plot is empty after its metric was changed");
      select.value = select.options[0].value;
      select.dispatchEvent(new Event("change"));
    }
    check(VIEWERS.length > 0, "there is no viewer");
    for (const viewer of VIEWERS) await testViewer(viewer, check);
    check(document.documentElement.scrollWidth <= document.documentElement.clientWidth, "the page is wider than the window");
    check(!/NaN|undefined|\[object/.test(document.getElementById("main").innerText), "a value is not a number");
  } catch (error) {
    problems.push(String(error));
  }
  problems.push(...window.tarnErrors.map((text) => "error: " + text));
  document.documentElement.dataset.charts = document.querySelectorAll(".chart canvas").length;
  document.documentElement.dataset.selftest = problems.length === 0 ? "passed" : "failed: " + problems.join("; ");
}
