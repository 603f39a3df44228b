// The player of a run's page: picture, controls, and the clock that the charts follow.

/// The moment that the charts follow and set. `time` [s] is that of the frame shown; null until there is a player.
const clock = {
  time: null, frame: null, followers: [],
  jump: () => {},  // to the frame nearest to a time
  follow(f) { this.followers.push(f); },
  set(time, frame) {
    Object.assign(this, {time, frame});
    this.followers.forEach(f => f());
  },
};

/// Turned by dragging and arrow keys; zoomed by + and -, and by the wheel once the picture has the focus, so that it does
/// not catch those who scroll past.
function steer(canvas, scene, keys) {
  const turn = (dx, dy) => {
    scene.turn -= dx;
    scene.tilt = Math.max(-1.4, Math.min(1.4, scene.tilt + dy));
    scene.draw();
  };
  const zoom = factor => {
    scene.zoom = Math.max(0.3, Math.min(20, scene.zoom * factor));
    scene.draw();
  };
  let from = null;
  canvas.addEventListener("pointerdown", e => {
    from = [e.clientX, e.clientY];
    canvas.setPointerCapture(e.pointerId);
  });
  canvas.addEventListener("pointermove", e => {
    if (!from) return;
    turn((e.clientX - from[0]) * 0.008, (e.clientY - from[1]) * 0.008);
    from = [e.clientX, e.clientY];
  });
  ["pointerup", "pointercancel"].forEach(end => canvas.addEventListener(end, () => { from = null; }));
  canvas.addEventListener("wheel", e => {
    if (document.activeElement !== canvas) return;
    e.preventDefault();
    zoom(Math.exp(-e.deltaY * 0.001));
  }, {passive: false});
  const actions = Object.assign({
    ArrowLeft: () => turn(-0.1, 0), ArrowRight: () => turn(0.1, 0), ArrowUp: () => turn(0, 0.1), ArrowDown: () => turn(0, -0.1),
    "+": () => zoom(1.2), "=": () => zoom(1.2), "-": () => zoom(1 / 1.2),
  }, keys);
  canvas.addEventListener("keydown", e => {
    if (!actions[e.key] || e.ctrlKey || e.altKey || e.metaKey) return;
    e.preventDefault();
    actions[e.key]();
  });
  return zoom;
}

/// Shows one frame after the other by the wall's clock; `rate` [simulated s per s].
function playback(times, shown, show, changed) {
  let running = 0, rate = 1, at = 0, last = null;
  const stop = () => {
    cancelAnimationFrame(running);
    running = 0;
    changed(false);
  };
  const step = now => {
    if (last !== null) at += (now - last) * 1e-3 * rate;
    last = now;
    const frame = Math.max(0, d3.bisectRight(times, at) - 1);
    if (frame !== shown()) show(frame);
    if (frame === times.length - 1) stop();
    else running = requestAnimationFrame(step);
  };
  return {
    toggle() {
      if (running) return stop();
      at = times[shown() === times.length - 1 ? 0 : shown()];
      last = null;
      running = requestAnimationFrame(step);
      changed(true);
    },
    stop,
    setRate(value) { rate = value; },
  };
}

const kRates = [0.1, 0.25, 0.5, 1, 2, 5];
const kCuts = ["none", "from the side", "from above", "from the outlet"];
const kCutAxes = [null, 0, 1, 2];

function playerControls(box, player, frames, scene) {
  const f = player.frames, times = f.time_s, list = quantities(player, frames);
  let shown = -1, quantity = list[0];
  const row = add(box, "div", null, "row"), state = box.querySelector(".state");
  const play = button(row, "▶", "play", () => running.toggle());
  const time = slider(row, "time", times.length - 1, i => jump(i));
  const show = i => {
    shown = i;
    time.value = i;
    const where = momentText(times[i], f.dose[i], f.phase[i]);
    time.setAttribute("aria-valuetext", where);
    state.textContent = `${where}; frame ${i + 1} of ${times.length}`;
    scene.show(i, quantity);
    clock.set(times[i], i);
  };
  const running = playback(times, () => shown, show, on => {
    play.textContent = on ? "❚❚" : "▶";
    play.setAttribute("aria-label", play.title = on ? "pause" : "play");
  });
  const jump = i => {
    running.stop();
    show(i);
  };
  const firstOfDose = n => f.dose.indexOf(n);
  const dose = change => {
    const i = firstOfDose(Math.max(0, f.dose[shown] + change));
    if (i >= 0) jump(i);
  };

  choice(row, "rate", kRates.map(r => `${r} ×`), i => running.setRate(kRates[i])).selectedIndex = kRates.indexOf(1);

  const settings = add(box, "div", null, "row");
  choice(settings, "colour", list.map(q => q.name), i => {
    quantity = list[i];
    paint();
  });
  const cutAxis = choice(settings, "cut", kCuts, () => cut());
  const cutPlace = slider(settings, "place of the cut", 200, () => cut());
  cutPlace.value = 100;
  const place = add(settings, "span", "", "place");
  const cut = () => {
    const axis = kCutAxes[cutAxis.selectedIndex];
    cutPlace.disabled = axis === null;
    place.textContent = "";
    if (axis === null) scene.cutOff();
    else place.textContent = `${"xyz"[axis]} = ${(Math.round(10 * scene.cutAt(axis, cutPlace.value / 200)) / 10 + 0).toFixed(1)} mm`;
    scene.draw();
  };

  const reset = () => {
    scene.resetView();
    scene.draw();
  };
  const canvas = box.querySelector("canvas");
  const zoom = steer(canvas, scene, {" ": () => running.toggle(), Home: reset, PageDown: () => dose(1), PageUp: () => dose(-1)});
  const view = add(box.querySelector(".stage"), "div", null, "view");
  button(view, "+", "nearer", () => zoom(1.2));
  button(view, "−", "farther", () => zoom(1 / 1.2));
  button(view, "⟲", "reset view", reset);

  const paint = () => {
    rampLegend(box, quantity);
    if (shown >= 0) scene.show(shown, quantity);
  };
  clock.jump = t => jump(nearestTime(times, t));
  clock.doseStart = n => (firstOfDose(n) >= 0 ? times[firstOfDose(n)] : null);
  clock.dose = () => (shown >= 0 ? f.dose[shown] : 0);
  paint();
  cut();
  show(f.settled);
}

/// A note for the reader on the picture's accuracy.
function playerNote(player) {
  const error = d3.max([0, 1, 2].map(k => player.high[k] - player.low[k])) / 131070 * 1e6;
  const fewer = player.frames.time_s.length < player.stored
    ? `${player.frames.time_s.length} of the ${player.stored} frames stored are in this file, to keep it below 25 MB. ` : "";
  return `${fewer}Positions are rounded by up to ${short(Number(error.toPrecision(2)))} µm, speeds by 3 %.`;
}

const kPlayerHelp = "Drag or use the arrow keys to turn; click the picture, then the wheel zooms; Space plays, Page Up and " +
  "Page Down go to another dose, Home to the first view. A click in a chart leads here.";

/// The figure is made at once, and its picture as soon as the frames are unpacked. If the picture cannot be shown, the
/// reason stands in its place.
function playerFigure(parent, player) {
  const box = add(parent, "figure", null, "viewer player");
  box.dataset.state = "loading";
  add(box, "h3", "The powder");
  const state = add(box, "p", "unpacking the frames", "state");
  const stage = add(box, "div", null, "stage"), canvas = add(stage, "canvas");
  canvas.tabIndex = 0;
  canvas.setAttribute("role", "application");
  canvas.setAttribute("aria-label", "powder, coil and bodies; arrow keys turn, plus and minus zoom, space plays");
  const legend = addLegend(box);
  const load = async () => {
    const frames = await readFrames(player);
    const scene = new PowderScene(canvas, player, frames);
    const fit = () => scene.resize(Math.max(1, stage.clientWidth), Math.max(1, stage.clientHeight));
    fit();
    playerControls(box, player, frames, scene);
    add(box, "figcaption", playerNote(player));
    add(box, "p", kPlayerHelp, "help");
    fit();
    new ResizeObserver(fit).observe(stage);
    player.unpacked = frames;
    clock.set(clock.time, clock.frame);
    box.dataset.state = "ready";
  };
  load().catch(error => {
    state.textContent = `The powder cannot be shown here: ${error.message || error}. The rest of this page needs nothing of it.`;
    stage.remove();
    legend.remove();
    box.dataset.state = "failed";
  });
}
