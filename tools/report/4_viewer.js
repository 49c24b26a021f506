// The picture viewer: two pictures side by side, under a slider, flipping, or as a FLIP map; zoom and pixel values.
"use strict";

const FLIP_PERIOD_MS = 700;
const VIEW_MODES = {side: "Side by side", slider: "Slider", flip: "Flip", difference: "FLIP map"};

function floatFromHalf(half) {
  const exponent = (half >> 10) & 31, fraction = half & 1023, sign = half & 0x8000 ? -1 : 1;
  if (exponent === 31) return fraction ? NaN : sign * Infinity;
  return sign * (exponent ? 2 ** (exponent - 15) * (1 + fraction / 1024) : 2 ** -14 * (fraction / 1024));
}

// Radiance at a pixel of what the page carries as half floats, or null.
function readRadiance(picture, x, y) {
  if (!picture.halves) {
    const text = atob(picture.radiance || "");
    picture.halves = new Uint16Array(Uint8Array.from(text, (letter) => letter.charCodeAt(0)).buffer);
  }
  const start = 3 * (y * picture.image.width + x);
  if (start + 2 >= picture.halves.length) return null;
  return [0, 1, 2].map((channel) => floatFromHalf(picture.halves[start + channel]));
}

function loadImage(source) {
  return new Promise((resolve, reject) => {
    const image = new Image();
    image.onload = () => resolve(image);
    image.onerror = () => reject(new Error("a picture cannot be decoded"));
    image.src = source;
  });
}

// Pictures are {label, display, flip, radiance}: PNG as data URLs and half floats in base64. It opens with `a` left of `b`,
// indices of pictures.
class Viewer {
  constructor(pictures, a, b) {
    this.pictures = pictures;
    this.state = {a, b, mode: "slider", split: 0.5, showsB: true, zoom: 1, x: 0.5, y: 0.5};
    this.canvas = element("canvas", {role: "img", "aria-label": "picture viewer", tabindex: "0"});
    this.readout = element("div", {class: "readout quiet"}, "Wheel or + and −: zoom; drag: move, or the slider.");
    this.box = element("div", {class: "viewer"}, this.makeControls(), this.canvas, this.readout);
    this.listen();
    this.ready = Promise.all(pictures.flatMap((picture) => [
      loadImage(picture.display).then((image) => { picture.image = image; }),
      picture.flip ? loadImage(picture.flip).then((image) => { picture.map = image; }) : null])).then(() => this.draw());
  }

  makeControls() {
    const choice = (side) => {
      const select = element("select", {"aria-label": side === "a" ? "left picture" : "right picture"},
        ...this.pictures.map((picture, index) => element("option", {value: index}, picture.label)));
      select.value = this.state[side];
      select.addEventListener("change", () => { this.state[side] = Number(select.value); this.draw(); });
      return select;
    };
    const modes = Object.entries(VIEW_MODES).filter(([mode]) => mode !== "difference" || this.pictures.some((p) => p.flip));
    this.buttons = modes.map(([mode, label]) => {
      const button = element("button", {"data-mode": mode}, label);
      button.addEventListener("click", () => this.setMode(mode));
      return button;
    });
    const zoom = (label, factor) => {
      const button = element("button", {"aria-label": factor > 1 ? "zoom in" : "zoom out"}, label);
      button.addEventListener("click", () => this.zoomBy(factor));
      return button;
    };
    const controls = element("div", {class: "controls"}, choice("a"), choice("b"), ...this.buttons, zoom("+", 2), zoom("−", 0.5));
    queueMicrotask(() => this.setMode(this.state.mode));
    return controls;
  }

  setMode(mode) {
    this.state.mode = mode;
    for (const button of this.buttons) button.setAttribute("aria-pressed", String(button.dataset.mode === mode));
    clearInterval(this.timer);
    this.state.showsB = true;
    if (mode === "flip") {
      this.timer = setInterval(() => { this.state.showsB = !this.state.showsB; this.draw(); }, FLIP_PERIOD_MS);
    }
    this.draw();
  }

  zoomBy(factor) {
    this.state.zoom = Math.min(64, Math.max(1, this.state.zoom * factor));
    this.clampView();
    this.draw();
  }

  clampView() {
    const reach = 0.5 / this.state.zoom;
    this.state.x = Math.min(1 - reach, Math.max(reach, this.state.x));
    this.state.y = Math.min(1 - reach, Math.max(reach, this.state.y));
  }

  // Panes in canvas pixels: which picture, what of it.
  panes() {
    const {a, b, mode, showsB} = this.state, {width, height} = this.canvas;
    const whole = {x: 0, y: 0, width, height};
    if (mode === "side" && this.isStacked()) {
      return [{...whole, height: height / 2, picture: a}, {...whole, y: height / 2, height: height / 2, picture: b}];
    }
    if (mode === "side") return [{...whole, width: width / 2, picture: a}, {...whole, x: width / 2, width: width / 2, picture: b}];
    if (mode === "flip") return [{...whole, picture: showsB ? b : a}];
    return [{...whole, picture: b}];
  }

  isStacked() {
    return this.canvas.clientWidth < 600;
  }

  resize() {
    const image = this.pictures[0].image, scale = window.devicePixelRatio || 1;
    const aspect = image.height / image.width, isSide = this.state.mode === "side";
    const width = Math.max(1, Math.round(this.canvas.clientWidth * scale));
    const height = Math.round(width * aspect * (isSide ? (this.isStacked() ? 2 : 0.5) : 1));
    if (this.canvas.width !== width || this.canvas.height !== height) Object.assign(this.canvas, {width, height});
  }

  draw() {
    if (!this.pictures.every((picture) => picture.image)) return;
    this.resize();
    const context = this.canvas.getContext("2d");
    context.imageSmoothingEnabled = false;
    for (const pane of this.panes()) {
      const picture = this.pictures[pane.picture];
      this.drawPane(context, this.state.mode === "difference" ? picture.map || picture.image : picture.image, pane);
      const label = this.state.mode === "difference" && picture.map ? `FLIP of ${picture.label}` : picture.label;
      this.drawLabel(context, label, pane.x + 8, pane.y + 8);
    }
    if (this.state.mode === "slider") this.drawSlider(context);
  }

  drawPane(context, image, pane) {
    const width = image.width / this.state.zoom, height = image.height / this.state.zoom;
    context.drawImage(image, this.state.x * image.width - width / 2, this.state.y * image.height - height / 2, width, height,
      pane.x, pane.y, pane.width, pane.height);
  }

  drawSlider(context) {
    const {width, height} = this.canvas, at = this.state.split * width;
    context.save();
    context.beginPath();
    context.rect(0, 0, at, height);
    context.clip();
    this.drawPane(context, this.pictures[this.state.a].image, {x: 0, y: 0, width, height});
    this.drawLabel(context, this.pictures[this.state.a].label, 8, 8);
    context.restore();
    this.drawLabel(context, this.pictures[this.state.b].label, width - 8, 8, "right");
    context.fillStyle = "#ffffff";
    context.fillRect(at - 1, 0, 2, height);
  }

  drawLabel(context, text, x, y, align = "left") {
    const size = 13 * (window.devicePixelRatio || 1);
    context.font = `${size}px sans-serif`;
    context.textBaseline = "top";
    context.textAlign = align;
    const width = context.measureText(text).width + 8;
    context.fillStyle = "rgba(0, 0, 0, 0.6)";
    context.fillRect(align === "left" ? x - 4 : x - width + 4, y - 3, width, size + 6);
    context.fillStyle = "#ffffff";
    context.fillText(text, x, y);
  }

  // The pixel of the pictures under a point of the canvas, and the pane it is in.
  locate(event) {
    const frame = this.canvas.getBoundingClientRect();
    const x = (event.clientX - frame.left) / frame.width * this.canvas.width;
    const y = (event.clientY - frame.top) / frame.height * this.canvas.height;
    const pane = this.panes().find((p) => x >= p.x && x < p.x + p.width && y >= p.y && y < p.y + p.height);
    if (!pane) return null;
    const image = this.pictures[0].image;
    const u = this.state.x + ((x - pane.x) / pane.width - 0.5) / this.state.zoom;
    const v = this.state.y + ((y - pane.y) / pane.height - 0.5) / this.state.zoom;
    return {x: Math.floor(u * image.width), y: Math.floor(v * image.height), u, v, share: x / this.canvas.width};
  }

  showValues(place) {
    const line = (index) => {
      const values = readRadiance(this.pictures[index], place.x, place.y);
      return values && `${this.pictures[index].label}: ${values.map(formatNumber).join("  ")}`;
    };
    this.readout.textContent = [`pixel ${place.x}, ${place.y}; radiance R G B`, line(this.state.a), line(this.state.b)]
      .filter(Boolean).join("\n");
  }

  listen() {
    let last = null;
    this.canvas.addEventListener("pointerdown", (event) => {
      this.canvas.setPointerCapture(event.pointerId);
      last = this.locate(event);
      const isOnSlider = last && this.state.mode === "slider" && (this.state.zoom === 1 || Math.abs(last.share - this.state.split) < 0.03);
      if (last) last.movesSlider = isOnSlider;
      if (isOnSlider) this.moveSlider(last.share);
    });
    this.canvas.addEventListener("pointermove", (event) => {
      const place = this.locate(event);
      if (!place) return;
      this.showValues(place);
      if (!last) return;
      if (last.movesSlider) {
        this.moveSlider(place.share);
        return;
      }
      this.state.x += last.u - place.u;
      this.state.y += last.v - place.v;
      this.clampView();
      this.draw();
      last = {...this.locate(event), movesSlider: false};
    });
    this.canvas.addEventListener("pointerup", () => { last = null; });
    this.canvas.addEventListener("wheel", (event) => {
      event.preventDefault();
      const before = this.locate(event);
      this.zoomBy(event.deltaY < 0 ? 1.5 : 1 / 1.5);
      const after = this.locate(event);
      if (before && after) {
        this.state.x += before.u - after.u;
        this.state.y += before.v - after.v;
        this.clampView();
        this.draw();
      }
    }, {passive: false});
    this.canvas.addEventListener("keydown", (event) => {
      if (event.key === "+" || event.key === "=") this.zoomBy(2);
      if (event.key === "-") this.zoomBy(0.5);
      if (event.key === "ArrowLeft" || event.key === "ArrowRight") {
        this.moveSlider(this.state.split + (event.key === "ArrowLeft" ? -0.02 : 0.02));
        event.preventDefault();
      }
    });
    new ResizeObserver(() => this.draw()).observe(this.canvas);
  }

  moveSlider(share) {
    this.state.split = Math.min(1, Math.max(0, share));
    this.draw();
  }
}
