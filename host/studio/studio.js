// The workbench. All that it knows it asks of the server, which asks the program.

const at = id => document.getElementById(id);

function say(text, bad) {
  at("message").textContent = text;
  at("message").className = bad ? "bad" : "";
}

/// The server's answer; its words if it refuses.
async function ask(path, body) {
  const post = {method: "POST", headers: {"Content-Type": "application/json"}, body: JSON.stringify(body)};
  const response = await fetch(path, body === undefined ? {} : post);
  const text = await response.text();
  let answer = null;
  try {
    answer = JSON.parse(text);
  } catch (_) {
    throw new Error(text.trim() || `the workbench answered ${response.status}`);
  }
  if (!response.ok) throw Object.assign(new Error(answer.error), {status: response.status});
  return answer;
}

const about = name => `name=${encodeURIComponent(name)}`;
const ofRun = run => `run=${encodeURIComponent(run)}`;

/// Does something that can fail, and tells the fault.
const tried = make => (...given) => Promise.resolve(make(...given)).catch(error => say(error.message, true));

// ---- the picture ----------------------------------------------------------------------------------------------------

const picture = {scene: null, frames: null, of: null};

/// Shows the first frame of the player's data. A picture of the same things keeps the view.
async function showPicture(player, of) {
  const frames = await readFrames(player);
  const same = picture.of === of && picture.frames.particles === frames.particles;
  if (same) {
    Object.assign(picture.frames, frames);
    picture.scene.player = player;
    picture.scene.bodies.forEach((body, i) => body.place(player.bodies[i]));
  } else {
    if (picture.scene) picture.scene.renderer.dispose();
    Object.assign(picture, {frames, of, scene: new PowderScene(at("scene"), player, frames)});
    steering();
  }
  at("view").hidden = false;
  picture.scene.show(0, quantities(player, picture.frames)[of.startsWith("out/") ? 0 : 3]);
  fitPicture();
  document.documentElement.dataset.picture = of;
}

const fitPicture = () => picture.scene && picture.scene.resize(Math.max(1, at("stage").clientWidth), Math.max(1, at("stage").clientHeight));
let steered = false;
function steering() {
  if (steered) return;
  steered = true;
  const now = {draw: () => picture.scene.draw()};
  ["turn", "tilt", "zoom"].forEach(name => Object.defineProperty(now, name, {
    get: () => picture.scene[name], set: value => { picture.scene[name] = value; },
  }));
  steer(at("scene"), now, {Home: () => { picture.scene.resetView(); picture.scene.draw(); }});
  new ResizeObserver(fitPicture).observe(at("stage"));
}

// ---- the case -------------------------------------------------------------------------------------------------------

const open = {name: null, saved: null, checked: 0};

const kCheckAfter = 350;  // ms without a key
let waiting = 0;

function numberLines(faults) {
  const marks = new Map();
  faults.forEach(f => { if (f.line > 0 && f.file === "" && marks.get(f.line) !== "b") marks.set(f.line, f.kind === "error" ? "b" : "i"); });
  const box = at("lines"), count = at("text").value.split("\n").length;
  box.textContent = "";
  for (let n = 1; n <= count; ++n) {
    if (marks.has(n)) add(box, marks.get(n), String(n));
    else box.appendChild(document.createTextNode(String(n)));
    box.appendChild(document.createTextNode("\n"));
  }
  box.scrollTop = at("text").scrollTop;
}

/// Puts the caret at a line, or at the line that has the key.
function goTo(fault) {
  const lines = at("text").value.split("\n");
  let line = fault.line;
  if (!line && fault.key) {
    const word = fault.key.split(".").pop();
    line = 1 + lines.findIndex(l => new RegExp(`^\\s*"?${word.replace(/[^\w-]/g, "\\$&")}"?\\s*=`).test(l));
  }
  if (!line) return;
  const from = lines.slice(0, line - 1).reduce((sum, l) => sum + l.length + 1, 0);
  at("text").focus();
  at("text").setSelectionRange(from, from + lines[line - 1].length);
  at("text").scrollTop = (line - 4) * 13 * 1.45;
}

function showFaults(found) {
  const faults = found.errors.map(f => Object.assign({kind: "error"}, f))
    .concat(found.warnings.filter(w => !w.accepted).map(w => Object.assign({kind: "warning", line: 0, file: ""}, w)));
  const list = at("faults");
  list.textContent = "";
  faults.forEach(f => {
    const place = f.file ? `${f.file}:${f.line}: ` : f.line > 0 ? `line ${f.line}: ` : "";
    const entry = add(add(list, "li"), "button", `${place}${f.key ? f.key + (f.value ? " = " + f.value : "") + ": " : ""}${f.text}`, f.kind);
    entry.type = "button";
    if (f.cure) add(entry, "small", f.cure);
    entry.addEventListener("click", () => goTo(f));
  });
  const count = (n, what) => `${n} ${what}${n === 1 ? "" : "s"}`;
  const errors = found.errors.length, warnings = faults.length - errors;
  at("verdict").textContent = faults.length === 0 ? "The case can be run." : `${count(errors, "error")}, ${count(warnings, "warning")}`;
  at("verdict").className = errors > 0 ? "contradicts" : warnings > 0 ? "within" : "matches";
  at("run").disabled = errors > 0;
  numberLines(faults);
}

const kFigures = [
  ["particles", "particles", x => String(x)], ["fill", "fill_kg", x => `${gramsText(x)} g`],
  ["time step", "time_step_s", x => `${short(1e6 * x)} µs`], ["steps", "steps", x => x.toLocaleString("en")],
  ["simulated time", "simulated_s", x => `${short(x)} s`], ["dose by the closed form", "dose_kg", x => `${gramsText(x)} g`],
  ["overlap under the bed", "overlap_under_bed", x => `${short(100 * x)} % of the radius`],
];

async function check() {
  const number = ++open.checked, name = open.name;
  const found = await ask("/api/check", {name, text: at("text").value});
  if (number !== open.checked || name !== open.name) return;  // another text has come meanwhile
  at("law").hidden = !found.law;
  if (found.law) {
    at("law-name").textContent = found.law.file;
    at("law-text").textContent = found.law.text;
    at("verdict").textContent = "The case waits for your word on its law.";
    at("verdict").className = "within";
    at("faults").textContent = "";
    at("run").disabled = true;
    document.documentElement.dataset.checked = String(number);
    return;
  }
  showFaults(found);
  const list = at("figures");
  list.textContent = "";
  if (found.figures)
    factRows(list, kFigures.filter(([, key]) => isNumber(found.figures[key]))
      .map(([label, key, text]) => ({name: label, value: text(found.figures[key])})));
  document.documentElement.dataset.checked = String(number);
  if (!found.scene) return;
  at("view-name").textContent = "Before the run";
  at("view-state").textContent = "The powder as it is filled in; colour is the radius.";
  await showPicture(found.scene, name);
}

const changed = () => {
  at("save").disabled = at("text").value === open.saved;
  numberLines([]);
  clearTimeout(waiting);
  waiting = setTimeout(tried(check), kCheckAfter);
};

async function openCase(name) {
  if (open.name && at("text").value !== open.saved && !window.confirm(`${open.name} has changes that are not saved. Drop them?`)) return;
  const {text} = await ask(`/api/case?${about(name)}`);
  Object.assign(open, {name, saved: text});
  at("text").value = text;
  at("case-name").textContent = name;
  at("case").hidden = false;
  at("save").disabled = true;
  say("");
  mark();
  history.replaceState(null, "", `#${about(name)}`);
  await check();
}

async function save() {
  const text = at("text").value;
  await ask("/api/save", {name: open.name, text, before: open.saved});
  open.saved = text;
  at("save").disabled = true;
  say(`saved ${open.name}`);
}

// ---- runs -----------------------------------------------------------------------------------------------------------

const live = {run: null, source: null};

const kDoseColumns = ["dose", "mass_kg", "cumulative_mass_kg", "complete", "closed_form_mass_kg"];

function drawRun() {
  live.drawing = 0;
  const box = at("charts");
  drawings.length = 0;
  box.textContent = "";
  if (live.doses.dose.length > 0) doseCharts(box, {doses: live.doses, filled_mass_kg: live.filled, beta_below_kg: NaN});
  const series = (title, key, unit, scale) => {
    const points = live.samples.map(s => [s.time_s, isNumber(s[key]) ? s[key] * scale : null]);
    chart(box, {title, x: {label: "s"}, y: {label: unit}, series: [{name: title, unnamed: true, points, colour: "var(--s0)", thin: true}]});
  };
  series("Dosed mass", "dosed_mass_kg", "g", gram);
  series("Torque of the coil", "coil_torque_Nm", "mN m", milli);
  drawings.forEach(again => again());
}

const kSamples = 2000;  // kept; beyond, every other one goes

function take(event) {
  if (event.event === "run") live.filled = event.filled_kg;
  if (event.event === "phase") {
    live.expected = event.expected_steps;
    live.phase = event.phase === "settle" ? "settling" : `dose ${event.dose}, ${event.phase}`;
  }
  if (event.event === "sample") {
    if (live.samples.length === 0 || event.time_s > live.samples[live.samples.length - 1].time_s) live.samples.push(event);
    if (live.samples.length > kSamples) live.samples = live.samples.filter((_, i) => i % 2 === 0);
    if (live.expected > 0 && isNumber(event.step)) at("progress").value = Math.min(1, event.step / live.expected);
    at("live-state").textContent = `${live.phase || "settling"}, t = ${event.time_s.toFixed(3)} s`;
  }
  if (event.event === "dose") {
    // A dose that was cut off by a stop is there already, and comes again whole.
    const known = live.doses.dose.indexOf(event.dose), place = known < 0 ? live.doses.dose.length : known;
    kDoseColumns.forEach(k => { live.doses[k][place] = k === "complete" ? Number(event[k]) : event[k]; });
  }
  if (event.event === "end") live.end = event;
  live.drawing = live.drawing || setTimeout(drawRun, 300);
}

const kPictureAfter = 1000;  // ms between two pictures
async function livePicture(run) {
  if (live.run !== run) return;
  const begun = Date.now(), player = await ask(`/api/frame?${ofRun(run)}`);
  if (live.run === run && player) {
    const frames = player.frames;
    at("view-name").textContent = run;
    at("view-state").textContent = momentText(frames.time_s[0], frames.dose[0], frames.phase[0]);
    await showPicture(player, run);
  }
  if (live.run === run && player === null)
    at("view-state").textContent = "No picture of the run yet: it shows as soon as the run has a frame (frames.interval_s).";
  // The picture takes at most a quarter of the time.
  if (live.run === run && live.source) setTimeout(tried(livePicture), Math.max(kPictureAfter, 3 * (Date.now() - begun)), run);
}

/// Shows a run: what its tables hold, then what it tells.
async function watch(run) {
  if (live.source) live.source.close();
  const {samples, doses} = await ask(`/api/history?${ofRun(run)}`);
  const before = samples.time_s.map((time_s, i) => ({time_s, dosed_mass_kg: samples.dosed_mass_kg[i], coil_torque_Nm: samples.coil_torque_Nm[i]}));
  const every = Math.ceil(before.length / kSamples);
  Object.assign(live, {run, samples: before.filter((_, i) => i % every === 0), doses, end: null, phase: "", expected: 0, filled: Infinity});
  at("live").hidden = false;
  at("live-name").textContent = run;
  at("live-state").textContent = "starting";
  at("charts").textContent = "";
  at("progress").value = 0;
  buttons(true);
  mark();
  live.source = new EventSource(`/api/events?${ofRun(run)}`);
  live.source.onmessage = message => take(JSON.parse(message.data));
  live.source.addEventListener("over", message => {
    live.source.close();
    live.source = null;
    const over = JSON.parse(message.data);
    const reason = live.end ? live.end.stop_sentence : over.known ? over.error : "It does not run now.";
    at("live-state").textContent = reason || `ended with ${over.code}`;
    drawRun();
    if (over.known && over.code === 0) at("progress").value = 1;
    buttons(false);
    document.documentElement.dataset.over = run;
    tried(list)();
    tried(livePicture)(run);
  });
  tried(livePicture)(run);
}

function buttons(running) {
  at("stop").disabled = !running;
  at("resume").disabled = at("report").disabled = running;
}

async function start(force) {
  if (at("text").value !== open.saved) await save();
  try {
    const {run} = await ask("/api/run", {name: open.name, force: force === true});
    say("");
    watch(run);
  } catch (error) {
    if (error.status !== 409 || force === true || !window.confirm(`${error.message}. Replace it?`)) throw error;
    await start(true);
  }
}

async function openReport() {
  say("making the report");
  await ask("/api/report", {run: live.run});
  say("");
  window.open(`/report?${ofRun(live.run)}`, "_blank", "noopener");
}

// ---- the folder -----------------------------------------------------------------------------------------------------

function entries(id, names, press) {
  const box = at(id);
  box.textContent = "";
  names.forEach(name => {
    const entry = add(add(box, "li"), "button", name);
    entry.type = "button";
    entry.addEventListener("click", tried(() => press(name)));
  });
  if (names.length === 0) add(box, "li", "none yet");
}

function mark() {
  const here = new Set([open.name, live.run]);
  document.querySelectorAll("nav li button").forEach(b => b.setAttribute("aria-current", here.has(b.textContent)));
}

async function list() {
  const found = await ask("/api/folder");
  at("folder").textContent = found.folder;
  entries("cases", found.cases, openCase);
  entries("runs", found.runs, watch);
  mark();
  return found;
}

async function make(event) {
  event.preventDefault();
  let name = at("new-name").value.trim();
  if (!name.endsWith(".toml")) name += ".toml";
  const {text} = await ask("/api/first");
  await ask("/api/save", {name, text, before: null});
  await list();
  await openCase(name);
}

async function begin() {
  at("text").addEventListener("input", changed);
  at("text").addEventListener("scroll", () => { at("lines").scrollTop = at("text").scrollTop; });
  at("save").addEventListener("click", tried(save));
  at("run").addEventListener("click", tried(start));
  at("stop").addEventListener("click", tried(() => ask("/api/stop", {run: live.run})));
  at("resume").addEventListener("click", tried(() => ask("/api/resume", {run: live.run}).then(() => watch(live.run))));
  at("report").addEventListener("click", tried(openReport));
  at("allow").addEventListener("click", tried(() => ask("/api/allow", {text: at("law-text").textContent}).then(check)));
  at("new").addEventListener("submit", tried(make));
  document.addEventListener("keydown", event => {
    if (!(event.ctrlKey || event.metaKey) || !open.name) return;
    if (event.key === "s") tried(save)();
    else if (event.key === "Enter" && !at("run").disabled) tried(start)();
    else return;
    event.preventDefault();
  });
  window.addEventListener("beforeunload", event => { if (open.name && at("text").value !== open.saved) event.preventDefault(); });
  const found = await list();
  const wanted = decodeURIComponent(location.hash.replace(/^#name=/, ""));
  const first = found.cases.includes(wanted) ? wanted : found.cases[0];
  if (first) await openCase(first);
  const running = await ask("/api/running");
  if (running.length > 0) watch(running[running.length - 1]);
  document.documentElement.dataset.state = "ready";
}

tried(begin)();
