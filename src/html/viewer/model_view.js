// One or two models behind one camera and one clock. The page drives it: show(), then at(...) for each frame.
import { Color, FrontSide, MeshStandardMaterial, DoubleSide } from 'three';
import { joint_color, kNewColor, paint_dominant, paint_sources, paint_values, paint_weight, source_color } from './colors.js';
import { wire, with_edges } from './edges.js';
import { Model } from './model.js';
import { look_at, make_camera, make_controls, make_renderer, make_scene, union } from './scene.js';
import { SkeletonView } from './skeleton.js';

function painted_material(mesh) {
  const side = mesh.material.side === DoubleSide ? DoubleSide : FrontSide;
  return with_edges(new MeshStandardMaterial({ vertexColors: true, roughness: 0.75, metalness: 0, side }));
}

export class ModelView {
  // `files`: one ArrayBuffer a model. `options`: is_dark, joint_source (per model: joint name -> source).
  static async open(canvas, files, options) {
    const models = [];
    for (const file of files) models.push(await Model.load(file, painted_material));
    return new ModelView(canvas, models, options);
  }

  constructor(canvas, models, options) {
    this.canvas = canvas;
    this.models = models;
    this.renderer = make_renderer(canvas);
    this.camera = make_camera();
    this.controls = make_controls(this.camera, canvas);
    this.controls.addEventListener('change', () => this.draw());
    this.skeletons = [];
    this.scenes = models.map((model) => this.scene_of(model, options));
    this.state = { clip: '', time: 0, colors: 'materials', joint: 0, wire: false, skeleton: false, floor: true };
    new ResizeObserver(() => this.resize()).observe(canvas);
    this.resize();
    this.frame();
  }

  scene_of(model, options) {
    const scene = make_scene(union(this.models), options.is_dark);
    const source_of = options.joint_source ?? new Map();
    const color_of = (j) => {
      const source = source_of.get(model.joints[j].userData?.name ?? model.joints[j].name);
      return source === undefined ? `#${joint_color(j, new Color()).getHexString()}` : source_color(source);
    };
    const skeleton = new SkeletonView(model, color_of);
    skeleton.group.visible = false;
    this.skeletons.push(skeleton);
    scene.add(model.root, skeleton.group);
    return scene;
  }

  resize() {
    const { clientWidth: width, clientHeight: height } = this.canvas;
    if (!width || !height) return;
    this.renderer.setSize(width, height, false);
    this.camera.aspect = width / this.models.length / height;
    this.camera.updateProjectionMatrix();
    this.draw();
  }

  frame() {
    look_at(union(this.models), this.camera, this.controls, this.camera.aspect || 1);
    this.draw();
  }

  joint_names() { return this.models[0].joints.map((joint) => joint.userData?.name ?? joint.name); }
  clip_names() { return this.models[0].clips.map((clip) => clip.name); }
  duration(name) { return Math.max(0, ...this.models.map((m) => m.clips.find((c) => c.name === name)?.duration ?? 0)); }

  // `colors`: materials | source (view data of the build) | joints | weight (of `joint`) | error (values in `data`).
  paint(colors, data) {
    this.state.colors = colors;
    this.models.forEach((model, i) => {
      if (colors === 'source') paint_sources(model, data);
      else if (colors === 'joints') paint_dominant(model);
      else if (colors === 'weight') paint_weight(model, data);
      else if (colors === 'error') paint_values(model, data[i]);
      else for (const part of model.parts) part.show_materials();
    });
    this.draw();
  }

  set_wire(on) { this.state.wire = on; wire.value = on ? 1 : 0; this.draw(); }
  set_skeleton(on) {
    this.state.skeleton = on;
    for (const skeleton of this.skeletons) skeleton.group.visible = on;
    this.draw();
  }
  set_floor(on) {
    for (const scene of this.scenes) scene.userData.floor.visible = on;
    this.draw();
  }

  at(clip, time) {
    this.state.clip = clip;
    this.state.time = time;
    for (const model of this.models) model.pose(clip, time);
    this.draw();
  }

  draw() {
    const { clientWidth: width, clientHeight: height } = this.canvas;
    const share = Math.floor(width / this.models.length);
    this.scenes.forEach((scene, i) => {
      scene.add(this.camera);  // its lights are for the scene that is drawn
      if (this.skeletons[i].group.visible) this.skeletons[i].update();
      this.renderer.setViewport(i * share, 0, share, height);
      this.renderer.setScissor(i * share, 0, share, height);
      this.renderer.render(scene, this.camera);
    });
  }

  source_color(source) { return source_color(source); }
  new_color() { return kNewColor; }
  grid_spacing() { return this.scenes[0].userData.spacing; }
}
