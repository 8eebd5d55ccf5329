// SPDX-License-Identifier: MIT
import { COLOURINGS, KIND_ORDER } from "./colours.js";

const kind = (name) => `palette[${KIND_ORDER.indexOf(name)}]`;
const mode = (id) => COLOURINGS.findIndex((c) => c.id === id);

/** Points come as they are stored; colouring and what is shown are uniforms. */
export const pointVertex = /* glsl */ `
in float verdict;
in float intensity;
in float time;
in float probability;
in vec2 groups;             // a bit for each that saw the point: low and high half

uniform vec3 low;
uniform float stepSize;
uniform vec3 palette[${KIND_ORDER.length}];
uniform vec3 background;
uniform sampler2D scales;
uniform float scaleCoordinate;
uniform int mode;
uniform int layers;         // a bit per verdict
uniform int shownGroups;    // all bits: points of no group, too
uniform bool markCorrected;
uniform float fade;         // towards the background
uniform vec2 heightScale;   // of the colouring
uniform vec2 heightCut, rangeCut;
uniform bool fromPath;
uniform vec3 sensor;
uniform sampler2D pathDistance;
uniform vec4 pathBox;       // low corner, 1 / size
uniform float pathReach;    // m at the value 1
uniform float pointWorld, pointLeast, pixelsPerMetre;

out vec3 colour;
out float size;

vec3 scaled(float value) { return texture(scales, vec2(0.998 * clamp(value, 0.0, 1.0) + 0.001, scaleCoordinate)).rgb; }

void main() {
  vec3 p = low + stepSize * position;
  int bits = int(verdict + 0.5);
  int settled = bits & 3, truth = (bits >> 2) & 3, instant = (bits >> 4) & 3;
  int shown = mode == ${mode("instant")} ? instant : settled;  // 3: not recorded

  float away = fromPath
    ? pathReach * texture(pathDistance, (p.xy - pathBox.xy) * pathBox.zw).r
    : distance(p, sensor);
  int seenBy = int(groups.x + 0.5) | (int(groups.y + 0.5) << 16);
  bool others = shownGroups != -1 && (seenBy & shownGroups) == 0;
  bool hidden = others || ((layers >> (shown % 3)) & 1) == 0 || p.z < heightCut.x || p.z > heightCut.y || away < rangeCut.x || away > rangeCut.y;
  if (hidden) {
    gl_Position = vec4(2.0, 2.0, 2.0, 1.0);
    gl_PointSize = 0.0;
    return;
  }

  float stress = 1.0;
  float height = (p.z - heightScale.x) / max(heightScale.y - heightScale.x, 1e-3);
  if (mode == ${mode("height")}) colour = scaled(height);
  else if (mode == ${mode("intensity")}) colour = scaled(intensity);
  else if (mode == ${mode("probability")}) colour = probability > 0.998 ? ${kind("none")} : scaled(probability * 255.0 / 254.0);
  else if (mode == ${mode("time")}) colour = scaled(time);
  else if (mode == ${mode("scans")}) colour = scaled(intensity);  // the pages of tiles have neither intensity nor time
  else if (mode == ${mode("drives")}) colour = scaled(time);
  else if (mode == ${mode("error")}) {
    bool removed = settled == 2;
    bool known = truth == 1 || truth == 2;
    stress = known && removed != (truth == 2) ? 2.0 : 1.0;  // errors are few: they have to be found
    colour = !known ? ${kind("none")} : truth == 1
      ? (removed ? ${kind("falseRemoved")} : ${kind("rightStatic")})
      : (removed ? ${kind("rightDynamic")} : ${kind("missed")});
  } else {
    colour = shown == 1 ? ${kind("static")} : shown == 2 ? ${kind("dynamic")} : shown == 3 ? ${kind("none")} : ${kind("unknown")};
    // A little height in the grey, so that a street can be read without another colouring.
    if (shown == 1) colour *= 0.86 + 0.2 * clamp(height, 0.0, 1.0);
  }
  bool corrected = markCorrected && instant != 3 && settled != instant;
  if (corrected) {
    colour = ${kind("corrected")};
    stress = 1.5;
  }
  colour = mix(colour, background, fade);

  vec4 eye = modelViewMatrix * vec4(p, 1.0);
  gl_Position = projectionMatrix * eye;
  size = stress * clamp(pointWorld * pixelsPerMetre / max(-eye.z, 0.01), pointLeast * stress, 24.0);
  gl_PointSize = size;
}`;

export const pointFragment = /* glsl */ `
in vec3 colour;
in float size;
out vec4 pixel;
void main() {
  vec2 off = gl_PointCoord - 0.5;
  if (size > 4.0 && dot(off, off) > 0.25) discard;
  pixel = vec4(colour, 1.0);
}`;

export const screenVertex = /* glsl */ `
out vec2 at;
void main() {
  at = 0.5 * position.xy + 0.5;
  gl_Position = vec4(position.xy, 0.0, 1.0);
}`;

/**
 * Eye-dome lighting: what lies behind its neighbours on the screen is darkened by how far (in octaves of depth),
 * so that edges and relief show without normals.
 */
export const screenFragment = /* glsl */ `
in vec2 at;
out vec4 pixel;
uniform sampler2D colours, depths;
uniform vec2 texel;
uniform float nearPlane, farPlane, strength;

float octaves(vec2 where) {
  float z = texture(depths, where).r;
  return log2(nearPlane * farPlane / (farPlane - z * (farPlane - nearPlane)));
}

void main() {
  vec3 colour = texture(colours, at).rgb;
  if (strength > 0.0 && texture(depths, at).r < 1.0) {
    float here = octaves(at);
    float sum = 0.0;
    sum += max(0.0, here - octaves(at + vec2(texel.x, 0.0)));
    sum += max(0.0, here - octaves(at - vec2(texel.x, 0.0)));
    sum += max(0.0, here - octaves(at + vec2(0.0, texel.y)));
    sum += max(0.0, here - octaves(at - vec2(0.0, texel.y)));
    colour *= exp(-strength * min(sum, 0.25));
  }
  pixel = vec4(colour, 1.0);
}`;
