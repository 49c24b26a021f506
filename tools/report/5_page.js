// Puts the page together from the documents it carries.
"use strict";

const VIEWERS = [];

function findPicture(document, names, label) {
  const name = (file) => file && PICTURES[`${document}/${file}`];
  return {label, display: name(names.display), flip: name(names.flip), radiance: name(names.radiance)};
}

// Opens on the pictures `a` and `b`, if the page has them.
function addViewer(box, pictures, a, b) {
  const shown = pictures.filter((picture) => picture.display);
  const viewer = new Viewer(shown, Math.max(0, shown.indexOf(a)), Math.max(0, shown.indexOf(b)));
  VIEWERS.push(viewer);
  box.append(viewer.box);
}

function makeMetricChoice(metrics, onChange) {
  const select = element("select", {"aria-label": "metric"},
    ...metrics.map((metric) => element("option", {value: metric}, METRIC_NAMES[metric])));
  select.addEventListener("change", () => onChange(select.value));
  return select;
}

// A figure whose metric can be chosen.
function makeMetricFigure(caption, metrics, makeConfiguration) {
  const figure = makeFigure(caption, () => makeConfiguration(metrics[0]));
  const canvas = figure.querySelector("canvas");
  figure.querySelector("figcaption").append(" ", makeMetricChoice(metrics, (metric) => {
    canvas.chart.destroy();
    canvas.chart = new Chart(canvas, makeConfiguration(metric));
  }));
  return figure;
}

function describeScene(scene, settings) {
  const reference = scene.reference;
  const camera = scene.camera ? `, camera ${scene.camera}` : "";
  return `${scene.width} x ${scene.height}${camera}; ${settings.seeds} seeds; reference of ${reference.spp} samples a pixel ` +
    `(noise: MSE ${formatNumber(reference.mean_variance)}); exposure ${reference.exposure_ev.toFixed(2)} EV; ` +
    `${reference.left_out_pixels} pixels on silhouettes left out`;
}

function makeSceneSection(scene, settings, number) {
  const box = element("section", {}, element("h2", {}, `${scene.name}: methods at equal time and equal error`),
    element("p", {class: "quiet"}, describeScene(scene, settings)), makeErrorTable(scene),
    element("details", {}, element("summary", {}, "More errors, correlation of neighbours, rays"), makeDetailTable(scene)));
  const charts = element("div", {class: "charts"},
    makeMetricFigure("Convergence: mean of 1, 2, 4, … frames. A curve that goes flat: bias, or frames that are correlated.",
      ["rel_mse", "rel_mse_trimmed", "mse"], (metric) => makeConvergence(scene, metric)),
    makeMetricFigure("Error at equal time.", ["rel_mse", "rel_mse_trimmed", "flip_ldr", "mape", "mse"],
      (metric) => makeErrorAgainstTime(scene, metric)),
    makeFigure("Time of each pass at the method's own settings.", () => makeScenePassBars(scene)));
  box.append(element("h3", {}, "Curves"), charts,
    element("h3", {}, "relMSE at equal time, over the best method's"), makeEqualTimeTable(scene),
    element("h3", {}, `Time to the error of ${scene.equal_error.baseline}`), makeEqualErrorTable(scene),
    element("h3", {}, "Slope of log MSE over log time"),
    element("p", {class: "quiet"}, "−1: all error is independent noise. Closer to 0: bias, or noise that is correlated in time."),
    makeSlopeTable(scene), element("h3", {}, "Pictures"));
  const reference = findPicture(number, scene.reference.pictures, "reference");
  const cells = scene.methods.flatMap((method) => method.cells.map((cell) => ({flip: cell.errors.flip_ldr.mean,
    picture: findPicture(number, cell.pictures, `${method.label}, ${describeCell(cell)}`)})));
  const best = cells.filter((cell) => cell.picture.display).sort((a, b) => a.flip - b.flip)[0];
  addViewer(box, [reference, ...cells.map((cell) => cell.picture)], best && best.picture, reference);
  box.append(element("h3", {}, "Counters: all should be 0"), makeCountTable(scene),
    element("details", {}, element("summary", {}, "Settings"), makeSettingTable(scene)));
  return box;
}

function makeFlightTable(flight) {
  return makeTable(["method", "median ms", "p95 ms", "relMSE", "FLIP", "energy", "flicker"], flight.methods.map((method, index) => {
    const mean = (name) => formatNumber(method.errors.reduce((sum, frame) => sum + frame[name], 0) / method.errors.length);
    const hasErrors = method.errors.length > 0;
    return {cells: [element("span", {title: method.sentence}, swatch(index), method.label), formatMs(method.frame_ms.median),
      formatMs(method.frame_ms.p95), ...["rel_mse", "flip_ldr", "mean_ratio", "flicker"].map((name) => hasErrors ? mean(name) : "–")]};
  }));
}

function makeFlightCharts(flight) {
  const lines = (get) => flight.methods.map((method, index) => ({label: method.label, colour: colourOf(index), points: get(method)}));
  const errorLines = (metric) => lines((method) => method.errors.map((frame) => ({x: frame.frame, y: frame[metric]})));
  const charts = element("div", {class: "charts"}, makeFigure("Time of each frame.", () =>
    makeFrameLines(lines((method) => method.frame_ms.per_frame.map((ms, index) => ({x: index, y: ms}))), "ms", false)));
  if (flight.measured.length > 0) {
    charts.append(makeMetricFigure("Error of single frames.", ["rel_mse", "rel_mse_trimmed", "flip_ldr", "mape"],
      (metric) => makeFrameLines(errorLines(metric), METRIC_NAMES[metric], true)),
      makeFigure("Flicker: change from frame to frame while nothing moves, relative to the mean.", () =>
        makeFrameLines(errorLines("flicker"), "flicker", false)));
  }
  charts.append(makeFigure("Time of each pass.", () => makePassBars(flight.methods.map((method) => ({label: method.label,
    passes: method.passes.map((pass) => ({name: pass.name, ms: pass.ms.median}))})))));
  return charts;
}

function makeFlightSection(flight, number) {
  const box = element("section", {}, element("h2", {}, `${flight.name}: flythrough ${flight.path}`), element("p", {class: "quiet"},
    `${flight.frames} frames${flight.interrupted ? ", interrupted" : ""}; references of ${flight.reference_spp} samples a pixel; ` +
    `exposure ${flight.exposure_ev.toFixed(2)} EV. Errors and flicker are means over ${flight.measured.length} measured frames.`),
    makeFlightTable(flight), makeFlightCharts(flight));
  const labels = [...flight.methods.map((method) => method.label), "reference"];
  const pictures = flight.measured.flatMap((moment) => labels.map((label) =>
    findPicture(number, {display: moment.pictures[label]}, `${label}, frame ${moment.frame}`)));
  if (pictures.length > 0) {
    box.append(element("h3", {}, "Pictures"));
    addViewer(box, pictures, pictures[0], pictures[labels.length - 1]);
  }
  return box;
}

function makePage() {
  const main = document.getElementById("main");
  document.getElementById("machine").textContent =
    describeProgram(DOCUMENTS[0]) + describeMachine(DOCUMENTS[0].machine);
  DOCUMENTS.forEach((results, number) => {
    if (results.comparison) main.append(makeComparison(results.comparison));
    for (const flight of results.flythroughs || []) main.append(makeFlightSection(flight, number));
    for (const scene of results.scenes || []) main.append(makeSceneSection(scene, results.settings, number));
  });
  setChartDefaults();
  drawFigures(main);
}

makePage();
if (new URLSearchParams(location.search).has("selftest")) runSelfTest();
