// For the scene of player_browser_test.cpp: works the player as a reader would and tells what is to be seen then.

// A display that shows a picture every 10 ms of a clock of its own, however long they take.
let ticks = 0;
const pictures = [];
window.requestAnimationFrame = draw => setTimeout(() => {
  draw(ticks += 10);
  const text = document.querySelector(".player .state").textContent;
  if (pictures.length === 0 || pictures[pictures.length - 1][1] !== text) pictures.push([ticks, text]);
}, 0);
window.cancelAnimationFrame = clearTimeout;

/// Pixels of a colour: their number, and their middle in parts of the picture, from the left and from below.
function colours(canvas) {
  const gl = canvas.getContext("webgl2"), [w, h] = [gl.drawingBufferWidth, gl.drawingBufferHeight];
  const pixels = new Uint8Array(4 * w * h), found = {yellow: [0, 0, 0], blue: [0, 0, 0], steel: [0, 0, 0]};
  gl.readPixels(0, 0, w, h, gl.RGBA, gl.UNSIGNED_BYTE, pixels);
  for (let i = 0; i < w * h; ++i) {
    const [r, g, b, a] = pixels.subarray(4 * i, 4 * i + 4);
    const add = name => found[name].forEach((_, k) => { found[name][k] += [1, (i % w + 0.5) / w, (Math.floor(i / w) + 0.5) / h][k]; });
    if (r > 1.3 * b && g > 1.3 * b) add("yellow");
    if (b > 1.6 * r && b > 1.1 * g) add("blue");
    if (a === 255 && r > 165 && b - r < 40 && b >= r) add("steel");
  }
  Object.keys(found).forEach(name => {
    const [n, x, y] = found[name];
    found[name] = {n, x: x / n, y: y / n};
  });
  return found;
}

function clickChart(title, part) {
  const svg = figureOf(title).querySelector("div > svg"), box = svg.getBoundingClientRect(), width = svg.viewBox.baseVal.width;
  const x = box.left + (52 + part * (width - 64)) * box.width / width;
  svg.dispatchEvent(new PointerEvent("pointerdown", {clientX: x, clientY: box.top + box.height / 2, buttons: 1, bubbles: true}));
}

async function probe() {
  const player = document.querySelector(".player"), found = {};
  while (player.dataset.state === "loading") await sleep();
  found.state = player.dataset.state;
  found.text = player.querySelector(".state").textContent;
  if (found.state !== "ready") return found;
  const canvas = player.querySelector("canvas"), [time, cut] = player.querySelectorAll("input[type=range]");
  const [rate, colour, axis] = player.querySelectorAll("select");
  const now = () => Object.assign(colours(canvas), {text: player.querySelector(".state").textContent});
  const set = (element, key, value, event) => {
    setControl(element, key, value, event);
    return now();
  };
  const key = name => {
    canvas.dispatchEvent(new KeyboardEvent("keydown", {key: name, bubbles: true}));
    return now();
  };
  const rule = title => {
    const line = figureOf(title).querySelector(".now");
    return line && line.style.display !== "none" ? Number(line.getAttribute("x1")) / (line.ownerSVGElement.viewBox.baseVal.width - 64) : null;
  };
  found.first = now();
  found.moved = set(time, "value", 1, "input");
  found.rule = rule("Torque of the drive");
  found.doseRule = rule("Mass per dose");
  found.gone = set(time, "value", 2, "input");
  set(time, "value", 0, "input");
  found.settledRule = rule("Mass per dose");
  set(axis, "selectedIndex", 3, "change");
  found.halved = now();
  found.place = player.querySelector(".place").textContent;
  found.hidden = set(cut, "value", 120, "input");
  set(cut, "value", 100, "input");
  set(axis, "selectedIndex", 1, "change");
  found.section = now();
  found.hiddenFromSide = set(cut, "value", 120, "input");
  set(axis, "selectedIndex", 2, "change");
  found.hiddenFromAbove = set(cut, "value", 200, "input");
  set(axis, "selectedIndex", 0, "change");
  found.nearer = key("+");
  found.turned = key("ArrowLeft");
  found.reset = key("Home");
  found.radius = set(colour, "selectedIndex", 3, "change");
  found.quantity = player.querySelector(".quantity").textContent;
  if (colour.options.length > 5) {
    found.own = set(colour, "selectedIndex", 5, "change");
    found.ownQuantity = player.querySelector(".quantity").textContent;
  }
  set(colour, "selectedIndex", 0, "change");
  clickChart("Torque of the drive", 0.5 / 0.7);
  found.byTime = now();
  clickChart("Mass per dose", 0.5 / 4);
  found.byDose = now();
  found.nextDose = key("PageDown");
  found.surface = figureOf("Surface of the powder").querySelectorAll("path[style*='--ink']")[0].getAttribute("d");
  const play = Array.from(player.querySelectorAll("button")).find(button => button.title === "play");
  play.click();
  while (play.title !== "play") await sleep();
  found.played = pictures;
  const data = JSON.parse(document.getElementById("data").textContent).player;
  const frames = await readFrames(data);
  found.positions = Array.from(frames.position);
  found.speeds = Array.from(frames.speed);
  found.here = [0, 1].map(i => [0, 1, 2].map(f => frames.here(i, f)));
  found.heights = Array.from(frames.surface);
  return found;
}
