// Lights, floor and camera, the same for every model.
import { Box3, Color, DirectionalLight, GridHelper, HemisphereLight, PerspectiveCamera, Scene, SRGBColorSpace,
  Vector3, WebGLRenderer } from 'three';
import { OrbitControls } from 'three/addons/controls/OrbitControls.js';

export function make_renderer(canvas) {
  const renderer = new WebGLRenderer({ canvas, antialias: true, preserveDrawingBuffer: true });
  renderer.outputColorSpace = SRGBColorSpace;
  renderer.setPixelRatio(Math.min(window.devicePixelRatio || 1, 2));
  renderer.setScissorTest(true);
  return renderer;
}

// The lights follow the camera, so that no side of the model lies in the dark.
export function make_camera() {
  const camera = new PerspectiveCamera(32, 1, 0.01, 1000);
  const key = new DirectionalLight('#ffffff', 1.9), fill = new DirectionalLight('#dfe8ff', 0.7);
  key.position.set(-0.6, 0.9, 0.8);
  fill.position.set(0.9, 0.1, 0.5);
  camera.add(key, fill, key.target, fill.target);
  key.target.position.set(0, 0, -1);
  fill.target.position.set(0, 0, -1);
  return camera;
}

// A round number of which a few make the size of the model: metres between the lines of the floor.
function spacing_of(size) {
  const step = 10 ** Math.floor(Math.log10(size / 4 || 1));
  return size / step > 20 ? 5 * step : size / step > 8 ? 2 * step : step;
}

export function make_scene(bounds, is_dark) {
  const scene = new Scene();
  scene.background = new Color(is_dark ? '#1b1e23' : '#eef0f2');
  scene.add(new HemisphereLight('#ffffff', is_dark ? '#5d6470' : '#a9adb5', 1.25));
  const size = bounds.getSize(new Vector3()), reach = Math.max(size.x, size.z, size.y / 2, 1e-3);
  const spacing = spacing_of(reach), lines = 2 * Math.ceil(1.6 * reach / spacing);
  const colors = is_dark ? ['#3c434d', '#2b3038'] : ['#c3c8cf', '#d8dce1'];
  const floor = new GridHelper(lines * spacing, lines, ...colors);
  const centre = bounds.getCenter(new Vector3());
  floor.position.set(Math.round(centre.x / spacing) * spacing, bounds.min.y, Math.round(centre.z / spacing) * spacing);
  scene.add(floor);
  scene.userData = { floor, spacing };
  return scene;
}

export function make_controls(camera, canvas) {
  const controls = new OrbitControls(camera, canvas);
  controls.enableDamping = false;
  controls.zoomToCursor = true;
  return controls;
}

// Three quarters from the front, the whole box in sight with a margin.
export function look_at(bounds, camera, controls, aspect) {
  const centre = bounds.getCenter(new Vector3()), size = bounds.getSize(new Vector3());
  const direction = new Vector3(Math.sin(0.7), 0.22, Math.cos(0.7)).normalize();
  const half = Math.tan((camera.fov * Math.PI) / 360);
  const across = new Vector3(direction.z, 0, -direction.x).normalize();
  const width = Math.abs(across.x) * size.x + Math.abs(across.z) * size.z;
  const depth = Math.abs(direction.x) * size.x + Math.abs(direction.z) * size.z;
  const distance = depth / 2 + Math.max(size.y * 1.04, (width * 1.04) / aspect) / 2 / half;
  camera.position.copy(centre).addScaledVector(direction, distance);
  camera.near = distance / 100;
  camera.far = distance * 100;
  camera.aspect = aspect;
  camera.updateProjectionMatrix();
  controls.target.copy(centre);
  controls.update();
}

export const union = (models) => models.reduce((box, model) => box.union(model.bounds), new Box3());
