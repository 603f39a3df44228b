// The bodies of the player's scene, in steel or as panes to see through. Lengths in millimetres.

/// Numbers of a kind out of base64.
function unpackNumbers(text, Kind) {
  const characters = atob(text), bytes = new Uint8Array(characters.length);
  for (let i = 0; i < bytes.length; ++i) bytes[i] = characters.charCodeAt(i);
  return new Kind(bytes.buffer);
}

const inMillimetresOf = text => unpackNumbers(text, Float32Array).map(x => 1e3 * x);

/// One object whose `show(f)` brings it to its place in a frame; `place(body)` takes the places out of newer data. `corners` are those of the body in its own frame.
function bodyObject(body) {
  const group = new THREE.Group(), faces = new THREE.BufferGeometry(), edges = new THREE.BufferGeometry();
  faces.setAttribute("position", new THREE.BufferAttribute(inMillimetresOf(body.points), 3));
  faces.setIndex(new THREE.BufferAttribute(unpackNumbers(body.triangles, Uint32Array), 1));
  faces.computeVertexNormals();
  edges.setAttribute("position", new THREE.BufferAttribute(inMillimetresOf(body.edges), 3));
  const steel = {color: 0xa9b2ba, specular: 0x555555, shininess: 40, side: THREE.DoubleSide};
  const pane = {color: 0x8fa3b5, transparent: true, opacity: 0.16, depthWrite: false, side: THREE.DoubleSide};
  const mesh = new THREE.Mesh(faces, new THREE.MeshPhongMaterial(body.pane ? pane : steel));
  group.add(mesh, new THREE.LineSegments(edges, new THREE.LineBasicMaterial({color: 0x6d7780})));
  let poses = null;
  group.place = of => { poses = unpackNumbers(of.poses, Float32Array); };
  group.place(body);
  group.show = f => {
    const [w, x, y, z, ...origin] = poses.subarray(7 * f, 7 * f + 7);
    group.quaternion.set(x, y, z, w);
    group.position.set(...origin.map(v => 1e3 * v));
    group.updateMatrixWorld();
  };
  group.corners = body.ends ? edges.attributes.position : null;
  group.name = body.name;
  return group;
}

/// Calls visit([x, y, z]) for points on the bodies that have an end, in their place in a frame [mm].
function forBodyCorners(objects, f, visit) {
  objects.filter(object => object.corners).forEach(object => {
    object.show(f);
    const faces = object.children[0].geometry.attributes.position;
    [faces, object.corners].forEach(list => {
      const corner = new THREE.Vector3();
      for (let i = 0; i < list.count; ++i) {
        corner.fromBufferAttribute(list, i).applyMatrix4(object.matrixWorld);
        visit(corner.toArray());
      }
    });
  });
}
