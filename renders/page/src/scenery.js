// Ground, obstacles and light.
import {
  BufferGeometry, Color, DirectionalLight, EdgesGeometry, Float32BufferAttribute, Group, HemisphereLight,
  LineBasicMaterial, LineSegments, Mesh, MeshLambertMaterial, PlaneGeometry,
} from 'three';
import { shapeMesh } from './shapes.js';

// Lines each metre, thinner ones each quarter, drawn from the position in the world: the same on a plane and on stairs.
const kLines = `
  vec2 nearMajor = abs(fract(vWorld.xz - 0.5) - 0.5) / fwidth(vWorld.xz);
  vec2 nearMinor = abs(fract(vWorld.xz * 4.0 - 0.5) - 0.5) / fwidth(vWorld.xz * 4.0);
  float major = 1.0 - min(min(nearMajor.x, nearMajor.y) / 1.4, 1.0);
  float minor = (1.0 - min(min(nearMinor.x, nearMinor.y), 1.0)) * 0.35;
  float farAway = smoothstep(4.0, 22.0, length(vWorld.xz - uMiddle.xz));
  diffuseColor.rgb = mix(diffuseColor.rgb, uLine, minor * (1.0 - farAway));
  diffuseColor.rgb = mix(diffuseColor.rgb, uMajorLine, major * (1.0 - farAway));
  diffuseColor.a *= 1.0 - farAway;
`;

function groundMaterial(colours, middle) {
  const material = new MeshLambertMaterial({ color: colours.ground, transparent: true });
  material.onBeforeCompile = (shader) => {
    shader.uniforms.uLine = { value: new Color(colours.line) };
    shader.uniforms.uMajorLine = { value: new Color(colours.majorLine) };
    shader.uniforms.uMiddle = { value: middle };
    shader.vertexShader = `varying vec3 vWorld;\n${shader.vertexShader}`.replace(
      '#include <begin_vertex>', '#include <begin_vertex>\nvWorld = (modelMatrix * vec4(position, 1.0)).xyz;');
    shader.fragmentShader = `varying vec3 vWorld; uniform vec3 uLine, uMajorLine, uMiddle;\n${shader.fragmentShader}`
      .replace('#include <color_fragment>', `#include <color_fragment>\n${kLines}`);
  };
  return material;
}

function groundShape(ground) {
  const geometry = new BufferGeometry();
  geometry.setAttribute('position', new Float32BufferAttribute(ground.positions, 3));
  const count = ground.positions.length / 3;
  if (ground.indices.length) geometry.setIndex(ground.indices.filter((i) => i >= 0 && i < count));
  // Each triangle with its own corners, so that edges of steps stay edges.
  const flat = geometry.index ? geometry.toNonIndexed() : geometry;
  flat.computeVertexNormals();
  return flat;
}

// `middle` is moved by the caller: the lines fade out around it.
export function groundMesh(ground, colours, middle) {
  const material = groundMaterial(colours, middle);
  let mesh;
  if (ground.positions) {
    mesh = new Mesh(groundShape(ground), material);
    material.side = 2;
    // Edges of steps: without them stairs seen from the front are one surface.
    mesh.add(new LineSegments(new EdgesGeometry(mesh.geometry, 20), new LineBasicMaterial({ color: colours.majorLine })));
  } else {
    mesh = new Mesh(new PlaneGeometry(400, 400).rotateX(-Math.PI / 2), material);
    mesh.position.y = ground.level;
  }
  mesh.receiveShadow = true;
  mesh.renderOrder = -1;  // Transparent only towards the horizon: everything else is drawn over it.
  return mesh;
}

export function obstacleGroup(obstacles, colours) {
  const material = new MeshLambertMaterial({ color: colours.obstacle });
  const group = new Group();
  for (const shape of obstacles) {
    const mesh = shapeMesh(shape, material);
    if (!mesh) continue;
    mesh.castShadow = mesh.receiveShadow = true;
    group.add(mesh);
  }
  return group;
}

// The sun goes along with the figure, so that a small shadow picture is enough.
export function lights(colours) {
  const group = new Group();
  group.add(new HemisphereLight(0xffffff, colours.dark ? 0x6b7580 : 0x9aa4ae, colours.dark ? 2.4 : 2.6));
  const sun = new DirectionalLight(0xffffff, 1.9);
  sun.castShadow = true;
  sun.shadow.mapSize.set(1024, 1024);
  sun.shadow.bias = -0.0005;
  sun.shadow.normalBias = 0.02;
  group.add(sun, sun.target);
  group.userData.follow = (middle, radius) => {
    sun.target.position.copy(middle);
    sun.position.set(middle.x + 1.4 * radius, middle.y + 3 * radius, middle.z + 1.1 * radius);
    const camera = sun.shadow.camera;
    camera.left = camera.bottom = -1.8 * radius;
    camera.right = camera.top = 1.8 * radius;
    camera.near = 0.1 * radius;
    camera.far = 8 * radius;
    camera.updateProjectionMatrix();
  };
  return group;
}
