// The picture of the device: before the run with its motion, and the powder of a run.

const picture = {scene: null, frames: null, of: null, motion: null, playing: 0};

/// Shows the first frame of the player's data. A picture of the same things keeps the view.
async function showPicture(player, of) {
  stopMotion();
  const frames = await readFrames(player);
  const same = picture.of === of && picture.frames.particles === frames.particles &&
    picture.scene.bodies.length === (player.bodies || []).length && JSON.stringify(picture.scene.player.coil) === JSON.stringify(player.coil);
  if (same && of.startsWith("out/")) {
    Object.assign(picture.frames, frames);
    picture.scene.player = player;
    picture.scene.bodies.forEach((body, i) => body.place(player.bodies[i]));
  } else {
    const view = same ? {turn: picture.scene.turn, tilt: picture.scene.tilt, zoom: picture.scene.zoom} : {};
    if (picture.scene) picture.scene.renderer.dispose();
    Object.assign(picture, {frames, of, scene: Object.assign(new PowderScene(at("scene"), player, frames), view)});
    steering();
  }
  picture.motion = player.motion || null;
  at("play").hidden = !picture.motion;
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

/// Brings the device to moment `i` of its motion; the powder stays.
function showMoment(i) {
  const {motion, scene} = picture;
  if (scene.coil) scene.coil.rotation.z = motion.coil_angle_rad[i];
  scene.bodies.forEach((body, b) => {
    body.place({poses: motion.poses[b]});
    body.show(i);
  });
  at("view-state").textContent = `${momentText(motion.time_s[i], motion.dose[i], motion.phase[i])}; the powder is not shown moving before it runs.`;
  scene.draw();
}

const kMomentFor = 40;  // ms
function playMotion() {
  if (picture.playing) return stopMotion();
  let i = 0;
  at("play").textContent = "Stop the motion";
  picture.playing = setInterval(() => {
    showMoment(i);
    document.documentElement.dataset.moment = String(i);
    if (++i >= picture.motion.time_s.length) stopMotion();
  }, kMomentFor);
}

function stopMotion() {
  clearInterval(picture.playing);
  picture.playing = 0;
  at("play").textContent = "Play the motion";
}

// ---- a mesh from a file ---------------------------------------------------------------------------------------------

const kUnits = ["mm", "m", "cm", "um", "inch"];
const mesh = {name: null};

async function takeMesh(file) {
  if (!open.name) throw new Error("open a case first; the mesh is to be a body of it");
  const folder = open.name.includes("/") ? open.name.slice(0, open.name.lastIndexOf("/") + 1) : "";
  const response = await fetch(`/api/mesh?${about(folder + file.name)}`,
    {method: "POST", headers: {"Content-Type": "application/octet-stream"}, body: await file.arrayBuffer()});
  const answer = await answerIn(response);
  mesh.name = file.name;
  at("mesh-name").textContent = file.name;
  at("mesh-facts").textContent = `${answer.triangles} triangles, ${answer.closed ? "closed" : "open"}${answer.mended ? `; mended: ${answer.mended}` : ""}`;
  const choice = at("mesh-choice");
  choice.textContent = "";
  kUnits.forEach(unit => {
    add(choice, "option", `${unit}: ${answer.size.map(x => short(x)).join(" × ")} ${unit}`).value = unit;
  });
  at("mesh-unit").hidden = false;
  choice.focus();
}

/// The mesh as one more body of the case.
async function addMesh(event) {
  event.preventDefault();
  const taken = new Set(form.stated.filter(s => /^body\[\d+\]\.name$/.test(s.key)).map(s => JSON.parse(s.text)));
  const count = countOf("body"), stem = mesh.name.replace(/\.[^.]*$/, "").replace(/[^\w-]/g, "-");
  let name = stem;
  for (let n = 2; taken.has(name); ++n) name = `${stem}-${n}`;
  let text = at("text").value;
  for (const [key, value] of [["name", name], ["mesh", mesh.name], ["unit", at("mesh-choice").value]])
    text = (await ask("/api/edit", {text, key: `body[${count}].${key}`, value: JSON.stringify(value)})).text;
  at("mesh-unit").hidden = true;
  setText(text);
}

function beginPicture() {
  at("play").addEventListener("click", playMotion);
  at("mesh").addEventListener("change", tried(() => {
    const [file] = at("mesh").files;
    at("mesh").value = "";
    return file && takeMesh(file);
  }));
  at("mesh-unit").addEventListener("submit", tried(addMesh));
  at("mesh-drop").addEventListener("click", () => { at("mesh-unit").hidden = true; });
  const stage = at("view");
  stage.addEventListener("dragover", event => event.preventDefault());
  stage.addEventListener("drop", tried(event => {
    event.preventDefault();
    const [file] = event.dataTransfer.files;
    return file && takeMesh(file);
  }));
}
