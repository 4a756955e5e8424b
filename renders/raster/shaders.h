// GLSL 3.30. "World" here has its origin at Camera::center_m, so that floats stay precise far from the origin.
#pragma once

namespace contort::shaders {

// A software rasterizer executes both sides of every branch, so different kinds of surfaces have separate programs.

// The program for all triangles. `rim` is the opacity of a translucent surface that faces the camera (1: opaque). pow()
// is slow here, so the highlight's 16th power is made by squaring, and gamma is 2.
inline constexpr char kSolidVertex[] = R"(#version 330 core
layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
uniform mat4 clip_from_world;
uniform mat4 world_from_mesh;
out vec3 at;
out vec3 facing;
void main() {
  vec4 world = world_from_mesh * vec4(position, 1.0);
  at = world.xyz;
  facing = mat3(world_from_mesh) * normal;
  gl_Position = clip_from_world * world;
}
)";

inline constexpr char kSolidFragment[] = R"(#version 330 core
in vec3 at;
in vec3 facing;
uniform vec4 color;
uniform vec3 eye;
uniform vec3 to_light;
uniform float rim;
out vec4 pixel;
void main() {
  vec3 n = normalize(facing);
  vec3 view = normalize(eye - at);
  float toward = dot(n, view);
  vec3 hemisphere = mix(vec3(0.30, 0.28, 0.27), vec3(0.62, 0.66, 0.72), 0.5 + 0.5 * n.y);
  float key = max(dot(n, to_light), 0.0);
  float shine = max(dot(n, normalize(view + to_light)), 0.0);
  shine *= shine, shine *= shine, shine *= shine, shine *= shine;
  float edge = 1.0 - abs(toward);
  vec3 light = hemisphere * (1.0 - 0.25 * edge * edge) + vec3(0.62, 0.60, 0.56) * key;
  vec3 linear = color.rgb * light + vec3(0.10 * shine * key);
  pixel = vec4(sqrt(min(linear, vec3(1.0))), color.a * mix(edge, 1.0, rim));
}
)";

// The program that draws the plain colour.
inline constexpr char kFlatVertex[] = R"(#version 330 core
layout(location = 0) in vec3 position;
uniform mat4 clip_from_world;
uniform mat4 world_from_mesh;
void main() { gl_Position = clip_from_world * (world_from_mesh * vec4(position, 1.0)); }
)";

inline constexpr char kFlatFragment[] = R"(#version 330 core
uniform vec4 color;
out vec4 pixel;
void main() { pixel = color; }
)";

// The sky: one triangle that covers the picture, shaded from `bottom` to `top`.
inline constexpr char kBackgroundVertex[] = R"(#version 330 core
out float height;
void main() {
  vec2 corner = vec2((gl_VertexID << 1) & 2, gl_VertexID & 2);
  height = corner.y;
  gl_Position = vec4(corner * 2.0 - 1.0, 0.0, 1.0);
}
)";

inline constexpr char kBackgroundFragment[] = R"(#version 330 core
in float height;
uniform vec4 bottom;
uniform vec4 top;
out vec4 pixel;
void main() { pixel = mix(bottom, top, clamp(height, 0.0, 1.0)); }
)";

// Level ground: a square around `middle`.
inline constexpr char kGroundVertex[] = R"(#version 330 core
uniform mat4 clip_from_world;
uniform vec3 middle;
uniform float reach;
out vec3 at;
void main() {
  vec2 corner = vec2((gl_VertexID & 1) * 2 - 1, (gl_VertexID & 2) - 1);
  at = middle + vec3(corner.x, 0.0, corner.y) * reach;
  gl_Position = clip_from_world * vec4(at, 1.0);
}
)";

// The two programs for ground, which begin with one of the two lines below. Both draw a line each metre and fainter
// ones each 25 cm, which fade toward `reach`. Shaped ground uses the vertex program kSolidVertex; it is shaded, less
// translucent, darker on risers, and has the shadows of the shadow map. Level ground is not shaded, and shadows are
// drawn onto it separately. With `show` 0 only depth is drawn.
inline constexpr char kLevel[] = "#version 330 core\n";
inline constexpr char kShaped[] = "#version 330 core\n#define SHAPED\n";
inline constexpr char kGroundFragment[] = R"(
in vec3 at;
uniform vec3 middle;
uniform vec3 world_origin;
uniform float reach;
uniform float show;
out vec4 pixel;

// Coverage of lines that are `width` pixels wide. Where several lines share a pixel they fade instead of flickering.
float lines(vec2 place, float step, float width) {
  vec2 coordinate = place / step;
  vec2 per_pixel = max(fwidth(coordinate), vec2(1e-6));
  vec2 away = abs(fract(coordinate - 0.5) - 0.5) / per_pixel;
  vec2 cover = clamp(0.5 * width + 0.5 - away, 0.0, 1.0) * (1.0 - smoothstep(0.15, 0.5, per_pixel));
  return max(cover.x, cover.y);
}

#ifdef SHAPED
in vec3 facing;
uniform vec4 color;
uniform vec3 to_light;
uniform mat4 light_from_world;
uniform sampler2DShadow nearest_to_light;

float shadow(vec3 n) {
  vec3 seen = (light_from_world * vec4(at, 1.0)).xyz * 0.5 + 0.5;
  bool outside = any(lessThan(seen, vec3(0.0))) || any(greaterThan(seen, vec3(1.0)));
  return outside || dot(n, to_light) <= 0.0 ? 0.0 : 1.0 - texture(nearest_to_light, seen - vec3(0.0, 0.0, 0.002));
}

vec4 ground(float line) {
  vec3 n = normalize(facing);
  float slant = 1.0 - smoothstep(0.0, 0.5, n.y);  // 1 on a riser, where no lines are drawn: a line along the riser
                                                  // would cover all of it
  float light = 0.62 + 0.5 * max(dot(n, to_light), 0.0) - 0.3 * slant;
  vec3 surface = mix(sqrt(color.rgb) * light, vec3(0.24, 0.29, 0.36), clamp(line * 1.6, 0.0, 1.0) * (1.0 - slant));
  return vec4(mix(surface, vec3(0.05, 0.07, 0.10), 0.3 * shadow(n)), color.a);
}
#else
vec4 ground(float line) {
  vec3 color = mix(vec3(0.70, 0.73, 0.77), vec3(0.24, 0.29, 0.36), clamp(line * 2.0, 0.0, 1.0));
  return vec4(color, 0.20 + 0.80 * line);
}
#endif

void main() {
  vec2 place = (at - world_origin).xz;
  float fade = 1.0 - smoothstep(0.35, 1.0, length((at - middle).xz) / reach);
  float line = max(0.42 * lines(place, 1.0, 2.6), 0.16 * lines(place, 0.25, 1.6));
  pixel = ground(line) * vec4(1.0, 1.0, 1.0, fade * show);
}
)";

}  // namespace contort::shaders
