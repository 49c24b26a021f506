// Puts the page together from the documents it carries.
"use strict";

const VIEWERS = [];

function findPicture(document, names, label) {
  const name = (file) => file && PICTURES[`${document}/${file}`];
  return {label, display: name(names.display), flip: name(names.flip), radiance: name(names.radiance)};
}

function addViewer(box, pictures) {
  const viewer = new Viewer(pictures.filter((picture) => picture.display));
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
    makeMetricFigure("Convergence: mean of 1, 2, 4, … frames; what goes flat is biased.",
      ["rel_mse", "rel_mse_trimmed", "mse"], (metric) => makeConvergence(scene, metric)),
    makeMetricFigure("Error at equal time.", ["rel_mse", "rel_mse_trimmed", "flip_ldr", "mape", "mse"],
      (metric) => makeErrorAgainstTime(scene, metric)),
    makeFigure("Time of each pass at the method's own settings.", () => makeScenePassBars(scene)));
  box.append(element("h3", {}, "Curves"), charts,
    element("h3", {}, `Time to the error of ${scene.equal_error.baseline}`), makeEqualErrorTable(scene),
    element("h3", {}, "Slope of log MSE over log time"),
    element("p", {class: "quiet"}, "−1 where all error is independent noise; nearer to 0 where bias or correlation in time stays."),
    makeSlopeTable(scene), element("h3", {}, "Pictures"));
  const pictures = [findPicture(number, scene.reference.pictures, "reference")];
  for (const method of scene.methods) {
    for (const cell of method.cells) pictures.push(findPicture(number, cell.pictures, `${method.label}, ${describeCell(cell)}`));
  }
  addViewer(box, pictures);
  box.append(element("h3", {}, "Counters: all should be 0"), makeCountTable(scene),
    element("details", {}, element("summary", {}, "Settings"), makeSettingTable(scene)));
  return box;
}

function makePage() {
  const main = document.getElementById("main");
  document.getElementById("machine").textContent = describeMachine(DOCUMENTS[0].machine);
  DOCUMENTS.forEach((results, number) => {
    if (results.comparison) main.append(makeComparison(results.comparison));
    for (const scene of results.scenes || []) main.append(makeSceneSection(scene, results.settings, number));
  });
  setChartDefaults();
  drawFigures(main);
}

makePage();
if (new URLSearchParams(location.search).has("selftest")) runSelfTest();
