// One character of a GLB, ready to be drawn in any of the view's colours.
import { AnimationMixer, Box3, Color, LoopRepeat, Float32BufferAttribute, Vector3 } from 'three';
import { GLTFLoader } from 'three/addons/loaders/GLTFLoader.js';
import { add_edges, with_edges } from './edges.js';

// Triangles of a polygon follow each other and begin at one vertex (FB_ngon_encoding). Polygons are numbered from 0.
function polygons_of(index) {
  const polygons = new Uint32Array(index.count / 3);
  for (let t = 1; t < polygons.length; ++t)
    polygons[t] = polygons[t - 1] + (index.getX(3 * t) === index.getX(3 * t - 3) ? 0 : 1);
  return polygons;
}

// A mesh with corners of their own for every triangle, so that neighbours can have different colours.
class Part {
  constructor(mesh, place, material_of) {
    const shared = mesh.geometry;
    const corners = Array.from(shared.index.array);
    this.mesh = mesh;
    this.place = place;  // its number in the file
    this.vertex_of_corner = corners;
    const polygons = polygons_of(shared.index);
    mesh.geometry = shared.toNonIndexed();
    mesh.geometry.boundingSphere = shared.boundingSphere;
    mesh.frustumCulled = false;  // its bounds are those of the bind pose
    add_edges(mesh.geometry, polygons, corners);
    this.own_colors = mesh.geometry.getAttribute('color') ?? null;
    this.colors = new Float32BufferAttribute(new Float32Array(3 * corners.length), 3);
    this.own_material = with_edges(mesh.material);
    this.painted_material = material_of(mesh);
  }

  corner_count() { return this.vertex_of_corner.length; }

  // Materials as the file has them.
  show_materials() {
    this.mesh.material = this.own_material;
    if (this.own_colors) this.mesh.geometry.setAttribute('color', this.own_colors);
    else this.mesh.geometry.deleteAttribute('color');
  }

  // color_of(corner, target): sets a THREE.Color.
  paint(color_of) {
    const color = new Color();
    for (let corner = 0; corner < this.corner_count(); ++corner) {
      color_of(corner, color);
      this.colors.setXYZ(corner, color.r, color.g, color.b);
    }
    this.colors.needsUpdate = true;
    this.mesh.geometry.setAttribute('color', this.colors);
    this.mesh.material = this.painted_material;
  }

  // Weights of a corner, as [joint, weight] pairs.
  influences(corner) {
    const rows = [];
    for (const set of ['', '_1']) {
      const joints = this.mesh.geometry.getAttribute(set ? 'joints_1' : 'skinIndex');
      const weights = this.mesh.geometry.getAttribute(set ? 'weights_1' : 'skinWeight');
      if (!joints || !weights) continue;
      for (let k = 0; k < 4; ++k) {
        const weight = weights.getComponent(corner, k);
        if (weight > 0) rows.push([joints.getComponent(corner, k), weight]);
      }
    }
    return rows;
  }
}

export class Model {
  static async load(bytes, painted_material) {
    const gltf = await new GLTFLoader().parseAsync(bytes, '');
    return new Model(gltf, painted_material);
  }

  constructor(gltf, painted_material) {
    this.root = gltf.scene;
    this.clips = gltf.animations;
    this.mixer = new AnimationMixer(this.root);
    this.action = null;
    const meshes = [];
    this.root.traverse((object) => { if (object.isMesh) meshes.push(object); });
    const order = (mesh) => {
      const link = gltf.parser.associations.get(mesh);
      return 10000 * link.meshes + (link.primitives ?? 0);
    };
    meshes.sort((a, b) => order(a) - order(b));
    this.parts = meshes.map((mesh, i) => new Part(mesh, i, painted_material));
    this.skeleton = meshes.find((mesh) => mesh.isSkinnedMesh)?.skeleton ?? null;
    this.joints = this.skeleton?.bones ?? [];
    this.root.updateMatrixWorld(true);
    this.bounds = new Box3();
    for (const part of this.parts) {
      part.mesh.geometry.computeBoundingBox();
      this.bounds.union(part.mesh.geometry.boundingBox);
    }
    if (this.bounds.isEmpty()) this.bounds.set(new Vector3(-1, 0, -1), new Vector3(1, 1, 1));
    this.rest = new Map();  // joints and meshes as the file has them
    this.root.traverse((o) => this.rest.set(o, [o.position.clone(), o.quaternion.clone(), o.scale.clone(),
      o.morphTargetInfluences?.slice()]));
  }

  // The pose of a clip, or with an empty name that of the file, at a time in seconds. Beyond its end a clip holds.
  pose(name, time) {
    const clip = this.clips.find((c) => c.name === name);
    if (this.action && this.action.getClip() !== clip) {
      this.mixer.stopAllAction();
      this.action = null;
    }
    if (!clip) {
      for (const [object, [position, rotation, scale, morphs]] of this.rest) {
        object.position.copy(position);
        object.quaternion.copy(rotation);
        object.scale.copy(scale);
        if (morphs) object.morphTargetInfluences.splice(0, morphs.length, ...morphs);
      }
    } else {
      if (!this.action) {
        this.action = this.mixer.clipAction(clip);
        this.action.setLoop(LoopRepeat);
        this.action.play();
      }
      this.action.time = Math.min(time, clip.duration - 1e-6);
      this.mixer.update(0);
    }
    this.root.updateMatrixWorld(true);
  }
}
