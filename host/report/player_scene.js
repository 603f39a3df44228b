// Powder, coil, bodies and canister in WebGL, on three.js. Lengths in millimetres, the case's axes. A particle is a square that
// faces the eye, on which the fragment shader finds the sphere, and the section where the cut goes through it.

const kSphereVertex = `
  attribute vec3 place;
  attribute float size;
  attribute vec4 tint;
  uniform vec3 low, extent;
  uniform vec4 cut;
  varying vec3 eyeCentre, eyePoint, colour;
  varying float radius;
  void main() {
    vec3 centre = low + place * extent;
    bool hidden = tint.a < 0.5 || dot(cut.xyz, centre) - size > cut.w;
    vec4 c = modelViewMatrix * vec4(centre, 1.0);
    // The sphere's outline seen from the eye is a circle nearer than its centre, wider than itself as seen there.
    float far = length(c.xyz);
    float reach = size * far / sqrt(max(far * far - size * size, 1e-6 * far * far));
    vec3 ahead = c.xyz / far, right = normalize(cross(ahead, vec3(0.0, 1.0, 1e-4))), up = cross(right, ahead);
    eyeCentre = c.xyz;
    eyePoint = c.xyz + reach * (position.x * right + position.y * up);
    radius = size;
    colour = tint.rgb;
    gl_Position = hidden ? vec4(2.0, 2.0, 2.0, 1.0) : projectionMatrix * vec4(eyePoint, 1.0);
  }`;

const kSphereFragment = `
  uniform vec4 eyeCut;
  uniform mat4 projectionMatrix;
  varying vec3 eyeCentre, eyePoint, colour;
  varying float radius;
  void main() {
    vec3 ray = normalize(eyePoint);
    float along = dot(ray, eyeCentre);
    float rest = along * along - dot(eyeCentre, eyeCentre) + radius * radius;
    if (rest < 0.0) discard;
    vec3 hit = ray * (along - sqrt(rest));
    vec3 normal = (hit - eyeCentre) / radius;
    float light = 0.45 + 0.55 * max(0.0, dot(normal, normalize(vec3(-0.3, 0.6, 1.0))));
    if (dot(eyeCut.xyz, hit) > eyeCut.w) {
      hit = ray * (eyeCut.w / dot(eyeCut.xyz, ray));
      if (distance(hit, eyeCentre) > radius || dot(hit, ray) < 0.0) discard;
      light = 0.95;  // flat, so that a section is told from a sphere
    }
    vec4 clip = projectionMatrix * vec4(hit, 1.0);
    gl_FragDepthEXT = 0.5 * clip.z / clip.w + 0.5;
    gl_FragColor = vec4(colour * light, 1.0);
  }`;

/// The line in the middle of the wire (geometry/coil.h), turned by nothing.
function coilLine(coil) {
  const line = new THREE.Curve();
  line.getPoint = t => {
    const psi = coil.start_angle + coil.hand * 2 * Math.PI * t * coil.length / coil.pitch;
    return new THREE.Vector3(1e3 * coil.radius * Math.cos(psi), 1e3 * coil.radius * Math.sin(psi), 1e3 * (coil.z_start + t * coil.length));
  };
  return line;
}

function coilObject(coil) {
  const group = new THREE.Group(), wire = 1e3 * coil.wire, line = coilLine(coil);
  const steel = new THREE.MeshPhongMaterial({color: 0xa9b2ba, specular: 0x555555, shininess: 40});
  const pieces = Math.max(8, Math.ceil(32 * coil.length / coil.pitch));
  group.add(new THREE.Mesh(new THREE.TubeBufferGeometry(line, pieces, wire, 10), steel));
  [0, 1].forEach(t => {
    const cap = new THREE.Mesh(new THREE.SphereBufferGeometry(wire, 12, 8), steel);
    cap.position.copy(line.getPoint(t));
    group.add(cap);
  });
  return group;
}

/// Edges of the canister as pairs of points: its cross-section at both ends, what joins them, the throat.
function canisterEdges(can) {
  const half = 500 * can.width, top = 1e3 * can.height - half, length = 1e3 * can.length, hole = 500 * can.outlet;
  const arc = (r, from, to, z) => d3.range(25).map(i => {
    const a = from + (to - from) * i / 24;
    return [r * Math.cos(a), r * Math.sin(a), z];
  });
  const section = z => {
    const floor = can.flat ? [[half, -half, z], [-half, -half, z]] : arc(half, 0, -Math.PI, z);
    return [[half, top, z]].concat(floor, [[-half, top, z], [half, top, z]]);
  };
  const lines = [section(0), section(length)];
  const corners = can.flat ? [[half, -half], [-half, -half]] : [[half, 0], [0, -half], [-half, 0]];
  corners.concat([[half, top], [-half, top]]).forEach(([x, y]) => lines.push([[x, y, 0], [x, y, length]]));
  [length, length + 1e3 * can.throat].forEach(z => lines.push(arc(hole, 0, 2 * Math.PI, z)));
  [0, 0.5, 1, 1.5].forEach(a => lines.push([arc(hole, a * Math.PI, 0, length)[0], arc(hole, a * Math.PI, 0, length + 1e3 * can.throat)[0]]));
  return d3.merge(lines.map(line => d3.merge(d3.pairs(line))));
}

function outline(can) {
  const geometry = new THREE.BufferGeometry();
  geometry.setAttribute("position", new THREE.BufferAttribute(Float32Array.from(d3.merge(canisterEdges(can))), 3));
  return new THREE.LineSegments(geometry, new THREE.LineBasicMaterial({color: 0x8a949e}));
}

/// All particles as one mesh; `fill` takes them from a frame.
function sphereObject(player, frames, uniforms) {
  const n = frames.particles, geometry = new THREE.InstancedBufferGeometry();
  geometry.setAttribute("position", new THREE.BufferAttribute(new Float32Array([-1, -1, 0, 1, -1, 0, 1, 1, 0, -1, 1, 0]), 3));
  geometry.setIndex([0, 1, 2, 0, 2, 3]);
  const place = new THREE.InstancedBufferAttribute(new Uint16Array(3 * n), 3, true);
  const tint = new THREE.InstancedBufferAttribute(new Uint8Array(4 * n), 4, true);
  geometry.setAttribute("place", place);
  geometry.setAttribute("size", new THREE.InstancedBufferAttribute(Float32Array.from(frames.radius, r => 1e3 * r), 1));
  geometry.setAttribute("tint", tint);
  geometry.maxInstancedCount = n;
  const material = new THREE.ShaderMaterial({
    uniforms, vertexShader: kSphereVertex, fragmentShader: kSphereFragment, side: THREE.DoubleSide, extensions: {fragDepth: true},
  });
  const mesh = new THREE.Mesh(geometry, material);
  mesh.frustumCulled = false;
  mesh.fill = (f, quantity) => {
    place.array.set(frames.position.subarray(3 * n * f, 3 * n * (f + 1)));
    for (let i = 0; i < n; ++i) {
      const entry = 3 * quantity.entry(f, i);
      for (let k = 0; k < 3; ++k) tint.array[4 * i + k] = kRamp[entry + k];
      tint.array[4 * i + 3] = frames.here(i, f) ? 255 : 0;
    }
    place.needsUpdate = tint.needsUpdate = true;
  };
  return mesh;
}

/// The corners [mm] of what the first view shows: the canister up to the settled powder, or where particles are, and the
/// bodies.
function viewBox(player, frames, bodies) {
  const low = [Infinity, Infinity, Infinity], high = [-Infinity, -Infinity, -Infinity];
  const include = (x, r) => x.forEach((v, k) => {
    low[k] = Math.min(low[k], v - r);
    high[k] = Math.max(high[k], v + r);
  });
  const settled = player.frames.settled;
  for (let i = 0; i < frames.particles; ++i)
    if (frames.here(i, settled))
      include([0, 1, 2].map(k => 1e3 * (player.low[k] + (player.high[k] - player.low[k]) *
        frames.position[3 * (settled * frames.particles + i) + k] / 65535)), 1e3 * frames.radius[i]);
  const can = player.canister;
  if (can) {
    include([-500 * can.width, -500 * can.width, 0], 0);
    include([500 * can.width, -500 * can.width, 1e3 * (can.length + can.throat)], 0);
  }
  forBodyCorners(bodies, settled, x => include(x, 0));
  return low[0] < high[0] ? {low, high} : {low: player.low.map(x => 1e3 * x), high: player.high.map(x => 1e3 * x)};
}

/// Draws into a canvas. Throws where the browser has no WebGL 2.
class PowderScene {
  constructor(canvas, player, frames) {
    const context = canvas.getContext("webgl2", {alpha: true, antialias: true, preserveDrawingBuffer: true});
    if (!context) throw new Error("this browser offers no WebGL 2");
    this.renderer = new THREE.WebGLRenderer({canvas, context, alpha: true, preserveDrawingBuffer: true});
    this.player = player;
    this.bodies = (player.bodies || []).map(bodyObject);
    this.box = viewBox(player, frames, this.bodies);
    this.uniforms = {
      low: {value: new THREE.Vector3(...player.low.map(x => 1e3 * x))},
      extent: {value: new THREE.Vector3(...player.low.map((x, k) => 1e3 * (player.high[k] - x)))},
      cut: {value: new THREE.Vector4()}, eyeCut: {value: new THREE.Vector4()},
    };
    this.camera = new THREE.PerspectiveCamera(28, 1, 1, 1e4);
    const light = new THREE.DirectionalLight(0xffffff, 0.8);
    light.position.set(-0.3, 0.6, 1);
    this.camera.add(light);
    this.scene = new THREE.Scene();
    this.scene.add(this.camera, new THREE.AmbientLight(0xffffff, 0.45));
    if (player.canister) this.scene.add(outline(player.canister));
    if (player.coil) this.scene.add(this.coil = coilObject(player.coil));
    this.bodies.forEach(body => this.scene.add(body));
    this.scene.add(this.spheres = sphereObject(player, frames, this.uniforms));
    this.cutOff();
    this.resetView();
  }

  show(f, quantity) {
    this.spheres.fill(f, quantity);
    if (this.coil) this.coil.rotation.z = this.player.frames.coil_angle_rad[f];
    this.bodies.forEach(body => body.show(f));
    this.draw();
  }

  /// Hides what lies beyond `part` of the box along an axis: 0 across (from the near side), 1 up, 2 along.
  cutAt(axis, part) {
    const [low, high] = [this.box.low[axis], this.box.high[axis]];
    const normal = [0, 0, 0];
    normal[axis] = axis === 0 ? -1 : 1;  // the first view is from -x
    const place = axis === 0 ? low + part * (high - low) : high - part * (high - low);
    this.uniforms.cut.value.set(...normal, normal[axis] * place);
    return place;
  }
  cutOff() { this.uniforms.cut.value.set(0, 0, 0, 1); }

  resetView() { Object.assign(this, {turn: 0.45, tilt: 0.28, zoom: 1}); }

  /// The camera looks at the middle of the box from a distance at which all its corners are in the picture.
  place() {
    const camera = this.camera, centre = new THREE.Vector3(...this.box.low).add(new THREE.Vector3(...this.box.high)).multiplyScalar(0.5);
    const back = new THREE.Vector3(-Math.cos(this.tilt) * Math.cos(this.turn), Math.sin(this.tilt), Math.cos(this.tilt) * Math.sin(this.turn));
    const right = new THREE.Vector3(0, 1, 0).cross(back).normalize(), up = back.clone().cross(right);
    const tall = Math.tan(camera.fov * Math.PI / 360), wide = tall * camera.aspect;
    let distance = 0;
    for (let corner = 0; corner < 8; ++corner) {
      const x = new THREE.Vector3(...[0, 1, 2].map(k => (corner >> k & 1 ? this.box.high : this.box.low)[k])).sub(centre);
      distance = Math.max(distance, x.dot(back) + Math.max(Math.abs(x.dot(up)) / tall, Math.abs(x.dot(right)) / wide));
    }
    distance *= 1.04 / this.zoom;
    camera.position.copy(centre).addScaledVector(back, distance);
    camera.lookAt(centre);
    camera.near = distance / 100;
    camera.far = distance * 20;
    camera.updateProjectionMatrix();
    camera.updateMatrixWorld();
  }

  /// Fits the picture to its element's size [CSS pixels].
  resize(width, height) {
    this.renderer.setPixelRatio(Math.min(2, window.devicePixelRatio || 1));
    this.renderer.setSize(width, height, false);
    this.camera.aspect = width / height;
    this.draw();
  }

  draw() {
    this.place();
    const cut = this.uniforms.cut.value;
    const plane = new THREE.Vector4(cut.x, cut.y, cut.z, -cut.w);
    // A plane moves with the inverse transpose of what moves its points, which here is the inverse of the camera's place.
    plane.applyMatrix4(this.camera.matrixWorld.clone().transpose());
    this.uniforms.eyeCut.value.set(plane.x, plane.y, plane.z, -plane.w);
    this.renderer.render(this.scene, this.camera);
  }
}
