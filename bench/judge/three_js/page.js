// Draws what of each light every pixel sees, by three.js's shadow maps, and posts it to the server that sent this page.
import * as THREE from "three";
import {GLTFLoader} from "three/addons/loaders/GLTFLoader.js";

const options = await (await fetch("/options")).json();
const {width, height} = options;

/** Lets a material show what its light's shadow map leaves, in place of its colours. */
function show_visibility(material) {
  material.onBeforeCompile = (shader) => {
    shader.fragmentShader = shader.fragmentShader
      .replace("void main() {", "#include <shadowmask_pars_fragment>\nvoid main() {")
      .replace("#include <opaque_fragment>", "gl_FragColor = vec4(vec3(getShadowMask()), 1.0);");
  };
  // Blended surfaces are drawn in any order there; truth takes them for opaque.
  material.transparent = false;
  material.needsUpdate = true;
}

/** Sets a light's shadow up as three.js's manual says: a map's size, a box or a range that holds the scene, biases. */
function set_shadow(light, box, settings) {
  light.castShadow = true;
  const {shadow} = light;
  if (settings.map_size) shadow.mapSize.set(settings.map_size, settings.map_size);
  if (settings.bias !== undefined) shadow.bias = settings.bias;
  if (settings.normal_bias !== undefined) shadow.normalBias = settings.normal_bias;
  if (settings.radius !== undefined) shadow.radius = settings.radius;
  const centre = box.getCenter(new THREE.Vector3()), radius = box.getSize(new THREE.Vector3()).length() / 2;
  const camera = shadow.camera;
  if (light.isDirectionalLight) {
    // The sun stands outside of the scene and looks at its middle; its box holds the whole scene.
    const towards = new THREE.Vector3();
    light.getWorldPosition(towards);
    const target = light.target.getWorldPosition(new THREE.Vector3());
    const direction = target.sub(towards).normalize();
    const scene = light.parent;
    light.target.removeFromParent();
    scene.attach(light.target);
    light.target.position.copy(scene.worldToLocal(centre.clone()));
    light.position.copy(scene.worldToLocal(centre.clone().addScaledVector(direction, -radius)));
    Object.assign(camera, {left: -radius, right: radius, bottom: -radius, top: radius, near: 0, far: 2 * radius});
  } else {
    const at = light.getWorldPosition(new THREE.Vector3());
    camera.near = settings.near ?? 0.05;
    camera.far = light.distance > 0 ? light.distance : at.distanceTo(centre) + radius;
  }
  camera.updateProjectionMatrix();
}

/** Name of a light's file, as Gnomon takes it: its node's name, or the light's own. */
const name_of = (light) => light.userData.name || light.parent?.userData.name || light.name || light.parent?.name;

async function main() {
  const renderer = new THREE.WebGLRenderer({antialias: false});
  renderer.setSize(width, height, false);
  renderer.toneMapping = THREE.NoToneMapping;
  renderer.shadowMap.enabled = true;
  const gltf = await new GLTFLoader().loadAsync("/scene.glb");
  const scene = new THREE.Scene();
  scene.add(gltf.scene);
  const camera = gltf.cameras[options.camera ?? 0];
  camera.aspect = width / height;
  camera.updateProjectionMatrix();
  scene.updateMatrixWorld(true);

  const lights = [], materials = new Set();
  const box = new THREE.Box3();
  scene.traverse((object) => {
    if (object.isLight) lights.push(object);
    if (!object.isMesh) return;
    object.castShadow = object.userData.castShadow !== false;  // extras of the file's nodes
    object.receiveShadow = true;
    materials.add(object.material);
    box.expandByObject(object, true);
  });
  for (const material of materials) show_visibility(material);

  const target = new THREE.WebGLRenderTarget(width, height, {type: THREE.FloatType});
  scene.background = new THREE.Color(-1, -1, -1);
  const pixels = new Float32Array(width * height * 4), visibility = new Float32Array(width * height);

  /** Lets some lights shine, some of them with shadows. */
  function switch_on(shining, shadowed) {
    lights.forEach((light) => { light.visible = shining.includes(light); light.castShadow = shadowed.includes(light); });
    scene.updateMatrixWorld(true);
    materials.forEach((material) => { material.needsUpdate = true; });
  }
  function draw(read_width, read_height) {
    renderer.setRenderTarget(target);
    renderer.render(scene, camera);
    renderer.readRenderTargetPixels(target, 0, 0, read_width, read_height, pixels);
  }
  /** Median milliseconds of a frame; a pixel is read, so that it has ended. Every frame draws all maps. */
  function median_ms(frames) {
    draw(1, 1);  // compiles
    const times = [];
    for (let i = 0; i < frames; ++i) {
      const begin = performance.now();
      draw(1, 1);
      times.push(performance.now() - begin);
    }
    return times.sort((a, b) => a - b)[times.length >> 1];
  }

  const times = {};
  for (const settings of options.settings) {
    if (settings.type) renderer.shadowMap.type = THREE[settings.type];
    for (const light of lights) {
      light.shadow.map?.dispose();
      light.shadow.map = null;
      set_shadow(light, box, settings);
    }
    for (const light of lights) {
      switch_on([light], [light]);
      draw(width, height);
      for (let i = 0; i < visibility.length; ++i) visibility[i] = pixels[4 * i];
      const names = `settings=${encodeURIComponent(settings.name)}&light=${encodeURIComponent(name_of(light))}`;
      await fetch(`/result?${names}`, {method: "POST", body: visibility.buffer});
    }
    if (!options.timed) continue;
    switch_on(lights, lights);
    const with_shadows = median_ms(options.timed);
    switch_on(lights, []);
    times[settings.name] = {with_ms: with_shadows, without_ms: median_ms(options.timed)};
  }
  const gl = renderer.getContext(), names = gl.getExtension("WEBGL_debug_renderer_info");
  const device = gl.getParameter(names ? names.UNMASKED_RENDERER_WEBGL : gl.RENDERER);
  await fetch("/end", {method: "POST", body: JSON.stringify({three: THREE.REVISION, device, times})});
}

main().catch((error) => fetch("/end", {method: "POST", body: JSON.stringify({error: String(error.stack ?? error)})}));
