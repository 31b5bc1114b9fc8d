// The skeleton of a model, drawn over its surface: each bone as a long octahedron from a joint to its child.
import { BufferGeometry, Color, Float32BufferAttribute, Group, InstancedMesh, Matrix4, MeshBasicMaterial,
  Quaternion, SphereGeometry, Vector3 } from 'three';

const kWaist = 0.12;  // of the bone's length, where it is widest
const kWidth = 0.055;
const kJoint = 0.006;  // radius of a joint, of the model's diagonal

// From the origin to (0, 1, 0); two tones, so that its edges show without light.
function bone_shape() {
  const tip = [0, 1, 0], root = [0, 0, 0];
  const ring = [[1, 0], [0, 1], [-1, 0], [0, -1]].map(([x, z]) => [kWidth * x, kWaist, kWidth * z]);
  const positions = [], colors = [];
  for (let k = 0; k < 4; ++k) {
    const a = ring[k], b = ring[(k + 1) % 4];
    positions.push(...a, ...b, ...tip, ...b, ...a, ...root);
    colors.push(...Array(18).fill(k % 2 ? 1 : 0.5));
  }
  const shape = new BufferGeometry();
  shape.setAttribute('position', new Float32BufferAttribute(positions, 3));
  shape.setAttribute('color', new Float32BufferAttribute(colors, 3));
  return shape;
}

export class SkeletonView {
  constructor(model, color_of) {
    this.joints = model.joints;
    this.radius = kJoint * model.bounds.getSize(new Vector3()).length();
    const indices = new Map(this.joints.map((joint, j) => [joint, j]));
    this.bones = this.joints.map((joint, j) => [indices.get(joint.parent), j]).filter(([parent]) => parent !== undefined);
    const over = { depthTest: false, transparent: true, opacity: 0.92, toneMapped: false };
    this.bodies = new InstancedMesh(bone_shape(), new MeshBasicMaterial({ ...over, vertexColors: true }),
      this.bones.length);
    this.balls = new InstancedMesh(new SphereGeometry(1, 12, 8), new MeshBasicMaterial(over), this.joints.length);
    const color = new Color(), white = new Color('#ffffff');
    const light = (joint) => color.set(color_of(joint)).lerp(white, 0.45);  // before a surface in the same colour
    this.bones.forEach(([parent], i) => this.bodies.setColorAt(i, light(parent)));
    this.joints.forEach((_, j) => this.balls.setColorAt(j, light(j)));
    this.group = new Group();
    [this.bodies, this.balls].forEach((mesh, i) => {
      mesh.frustumCulled = false;
      mesh.renderOrder = 10 + i;
      this.group.add(mesh);
    });
  }

  update() {
    const at = this.joints.map((joint) => new Vector3().setFromMatrixPosition(joint.matrixWorld));
    const up = new Vector3(0, 1, 0), matrix = new Matrix4(), turn = new Quaternion(), size = new Vector3();
    this.bones.forEach(([a, b], i) => {
      const along = at[b].clone().sub(at[a]), length = along.length();
      turn.setFromUnitVectors(up, length > 0 ? along.divideScalar(length) : up);
      this.bodies.setMatrixAt(i, matrix.compose(at[a], turn, size.setScalar(Math.max(length, 1e-9))));
    });
    at.forEach((p, j) => this.balls.setMatrixAt(j, matrix.compose(p, turn.identity(), size.setScalar(this.radius))));
    this.bodies.instanceMatrix.needsUpdate = this.balls.instanceMatrix.needsUpdate = true;
  }
}
