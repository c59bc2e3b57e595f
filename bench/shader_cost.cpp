// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// What the parts of shaders/ cost: processor time of a call on this machine's OpenGL ES, all
// threads together, without a window. Meant for a driver that runs on the processor, as Mesa's
// llvmpipe does.
//   ltcfit convert out/ltc.h5 -o table.glsl && ltcfit generate --config config/field.toml -o field
//   ltcfit convert field/ltc_field.json -o field.glsl, and so a folded one
//   ltcfit_shader_cost shaders/glsl table.glsl field.glsl folded.glsl
// Each is called 64 times a pixel with other arguments; the fastest of seven pictures counts, less
// that of a shader without the call.
#include <EGL/egl.h>
#include <EGL/eglext.h>
#include <GLES3/gl32.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <ctime>
#include <fstream>
#include <iostream>
#include <limits>
#include <map>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

namespace {

constexpr int picture_side = 256, calls = 64, pictures = 7;

// Lobes that cost next to nothing, so that what is done with them is measured alone.
constexpr const char* no_lobe = "";
constexpr const char* cheap_lobe =
    "LtcLobe lobe = ltc_lobe_of_rows(vec3(a, 0.0, 0.1), vec3(0.0, b, 0.1), vec3(0.0, -0.1, 1.0), "
    "1.0, 0.0);\n";
constexpr const char* cheap_folded_lobe =
    "LtcFoldedLobe lobe = ltc_folded_lobe_of(ltc_lobe_of_rows(vec3(a, 0.0, 0.1), vec3(0.0, b, "
    "0.1), vec3(0.0, -0.1, 1.0), 1.0, 0.0), vec3(b - 0.7, a - 0.5, 0.4));\n";

struct Measured {
  const char* name;
  const char* lobe;  // what stands before the call, whose own time is not counted
  const char* call;  // makes `x` of `lobe`, `view`, `a`, `b` and the light p, u, v
};
constexpr std::array<Measured, 23> measured = {{
    {"look-up, three textures, filtered", no_lobe,
     "x = sum(ltc_look_up(t0, t1, t2, LTC_TABLE, view, a, b));"},
    {"look-up, three textures, by texels", no_lobe,
     "x = sum(ltc_look_up_exact(t0, t1, t2, LTC_TABLE, view, a, b));"},
    {"look-up, field", no_lobe, "x = sum(ltc_look_up_field(view, a, b));"},
    {"look-up, folded field", no_lobe, "x = sum_folded(ltc_look_up_folded_field(view, a, b));"},
    {"look-up, isotropic 64 x 64", no_lobe,
     "x = sum(ltc_look_up_isotropic(i0, i1, 64.0, view, a));"},
    {"quad, above the horizon", cheap_lobe, "x = ltc_quad(lobe, p, p + u, p + u + v, p + v);"},
    {"quad, cut", cheap_lobe,
     "x = ltc_quad(lobe, p - 3.0 * u, p + u, p + u + v, p - 3.0 * u + v);"},
    {"quad as a sphere", cheap_lobe, "x = ltc_quad_as_sphere(lobe, p, p + u, p + u + v, p + v);"},
    {"disk, above the horizon", cheap_lobe, "x = ltc_ellipse(lobe, p, 0.2 * u, 0.2 * v);"},
    {"disk, cut", cheap_lobe, "x = ltc_ellipse(lobe, p, 4.0 * u, v);"},
    {"sphere", cheap_lobe, "x = ltc_sphere(lobe, p, 0.2);"},
    {"line", cheap_lobe, "x = ltc_line(lobe, p, p + u, 0.01);"},
    {"picture's fetch", cheap_lobe, "x = ltc_picture(i0, 64.0, lobe, p, u, v).x;"},
    {"horizon's factor", cheap_lobe, "x = ltc_horizon_factor(lobe);"},
    {"folded: horizon's factor", cheap_folded_lobe, "x = ltc_horizon_factor_folded(lobe);"},
    {"folded: quad, above the horizon", cheap_folded_lobe,
     "x = ltc_quad_folded(lobe, p, p + u, p + u + v, p + v);"},
    {"folded: quad, cut", cheap_folded_lobe,
     "x = ltc_quad_folded(lobe, p - 3.0 * u, p + u, p + u + v, p - 3.0 * u + v);"},
    {"folded: disk", cheap_folded_lobe, "x = ltc_ellipse_folded(lobe, p, 0.2 * u, 0.2 * v);"},
    {"folded: line", cheap_folded_lobe, "x = ltc_line_folded(lobe, p, p + u, 0.01);"},
    {"field, one light", no_lobe,
     "LtcLobe lobe = ltc_look_up_field(view, a, b);"
     "x = ltc_quad(lobe, p, p + u, p + u + v, p + v);"},
    {"folded field, one light", no_lobe,
     "LtcFoldedLobe lobe = ltc_look_up_folded_field(view, a, b);"
     "x = ltc_quad_folded(lobe, p, p + u, p + u + v, p + v);"},
    {"field, eight lights", no_lobe,
     "LtcLobe lobe = ltc_look_up_field(view, a, b);"
     "for (int j = 0; j < 8; ++j) {"
     "  vec3 q = p + 0.1 * float(j) * u;"
     "  x += ltc_quad(lobe, q, q + u, q + u + v, q + v);"
     "}"},
    {"folded field, eight lights", no_lobe,
     "LtcFoldedLobe lobe = ltc_look_up_folded_field(view, a, b);"
     "for (int j = 0; j < 8; ++j) {"
     "  vec3 q = p + 0.1 * float(j) * u;"
     "  x += ltc_quad_folded(lobe, q, q + u, q + u + v, q + v);"
     "}"},
}};

std::string read_file(const std::string& name) {
  std::ifstream file(name, std::ios::binary);
  if (!file)
    throw std::runtime_error("cannot read " + name);
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

void open_context() {
  const auto get_display = reinterpret_cast<PFNEGLGETPLATFORMDISPLAYEXTPROC>(
      eglGetProcAddress("eglGetPlatformDisplayEXT"));
  const EGLDisplay display =
      get_display ? get_display(EGL_PLATFORM_SURFACELESS_MESA, nullptr, nullptr) : EGL_NO_DISPLAY;
  if (!eglInitialize(display, nullptr, nullptr))
    throw std::runtime_error("no EGL without a display");
  eglBindAPI(EGL_OPENGL_ES_API);
  const EGLint version[] = {EGL_CONTEXT_MAJOR_VERSION, 3, EGL_NONE};
  const EGLContext context = eglCreateContext(display, EGL_NO_CONFIG_KHR, EGL_NO_CONTEXT, version);
  if (!eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, context))
    throw std::runtime_error("no OpenGL ES 3");
}

GLuint compile(GLenum kind, const std::string& source) {
  const GLuint shader = glCreateShader(kind);
  const char* text = source.c_str();
  glShaderSource(shader, 1, &text, nullptr);
  glCompileShader(shader);
  GLint done = 0;
  glGetShaderiv(shader, GL_COMPILE_STATUS, &done);
  char log[4096] = "";
  glGetShaderInfoLog(shader, sizeof log, nullptr, log);
  if (!done)
    throw std::runtime_error(log);
  return shader;
}

// Arguments differ from call to call and from pixel to pixel.
std::string fragment(const std::string& body) {
  return R"(
uniform sampler3D t0, t1, t2;
uniform sampler2D i0, i1;
out vec4 color;
float sum(LtcLobe l) { return dot(l.w0 + l.w1 + l.w2, vec3(1.0)) + l.amplitude; }
float sum_folded(LtcFoldedLobe l) { return sum(l.lobe) + l.k + l.g; }
void main() {
  float total = 0.0;
  for (int i = 0; i < )" +
         std::to_string(calls) + R"(; ++i) {
    vec2 r = fract(gl_FragCoord.xy * 0.0039 + float(i) * vec2(0.754878, 0.569840));
    vec3 view = normalize(vec3(r - 0.5, 0.1 + r.x));
    float a = 0.1 + 0.9 * r.y, b = 0.1 + 0.5 * r.x;
    vec3 p = vec3(r - 0.7, 1.0), u = vec3(0.9, 0.1, -0.2 - 0.1 * r.x), v = vec3(0.1, 0.8, 0.1);
    float x = r.x;
    )" + body +
         R"(
    total += x;
  }
  color = vec4(total);
}
)";
}

void bind_textures(GLuint program) {
  const std::vector<float> noise(std::size_t{4} * 8 * 8 * 64, 0.4f);
  for (const auto& [name, unit] :
       {std::pair("t0", 0), {"t1", 1}, {"t2", 2}, {"i0", 3}, {"i1", 4}}) {
    const bool volume = name[0] == 't';
    const GLenum target = volume ? GL_TEXTURE_3D : GL_TEXTURE_2D;
    GLuint texture = 0;
    glGenTextures(1, &texture);
    glActiveTexture(GL_TEXTURE0 + static_cast<GLenum>(unit));
    glBindTexture(target, texture);
    if (volume)
      glTexImage3D(target, 0, GL_RGBA16F, 8, 8, 64, 0, GL_RGBA, GL_FLOAT, noise.data());
    else
      glTexImage2D(target, 0, GL_RGBA16F, 64, 64, 0, GL_RGBA, GL_FLOAT, noise.data());
    glTexParameteri(target, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
    glTexParameteri(target, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
    glUniform1i(glGetUniformLocation(program, name), unit);
  }
}

// Nanoseconds a call.
double time_of(const std::string& version, const std::string& library, const std::string& body) {
  const GLuint program = glCreateProgram();
  glAttachShader(program, compile(GL_VERTEX_SHADER, version + R"(
void main() {
  gl_Position = vec4(gl_VertexID == 1 ? 3.0 : -1.0, gl_VertexID == 2 ? 3.0 : -1.0, 0.0, 1.0);
})"));
  glAttachShader(program, compile(GL_FRAGMENT_SHADER, version + library + fragment(body)));
  glLinkProgram(program);
  glUseProgram(program);
  bind_textures(program);
  std::clock_t fastest = std::numeric_limits<std::clock_t>::max();
  for (int i = 0; i <= pictures; ++i) {
    const std::clock_t began = std::clock();
    glDrawArrays(GL_TRIANGLES, 0, 3);
    glFinish();
    // The first one compiles.
    if (i > 0)
      fastest = std::min(fastest, std::clock() - began);
  }
  return 1e9 * static_cast<double>(fastest) / CLOCKS_PER_SEC /
         (picture_side * picture_side * calls);
}

void run(const std::string& shaders, const std::string& table, const std::string& field,
         const std::string& folded) {
  open_context();
  GLuint target = 0, frame = 0, vertices = 0;
  glGenVertexArrays(1, &vertices);
  glBindVertexArray(vertices);
  glGenRenderbuffers(1, &target);
  glBindRenderbuffer(GL_RENDERBUFFER, target);
  glRenderbufferStorage(GL_RENDERBUFFER, GL_RGBA8, picture_side, picture_side);
  glGenFramebuffers(1, &frame);
  glBindFramebuffer(GL_FRAMEBUFFER, frame);
  glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER, target);
  glViewport(0, 0, picture_side, picture_side);
  std::string library = read_file(shaders + "/ltc_lobe.glsl");
  for (const char* const name :
       {"table", "polygon", "disk", "line", "texture", "isotropic", "folded", "folded_lights"})
    library += read_file(shaders + "/ltc_" + name + ".glsl");
  library += read_file(table) + read_file(field) + read_file(folded) +
             read_file(shaders + "/ltc_field.glsl") + read_file(shaders + "/ltc_folded_field.glsl");
  const std::string version =
      "#version 300 es\nprecision highp float;\nprecision highp int;\nprecision highp sampler3D;\n"
      "precision highp sampler2D;\n";
  std::cout << fmt::format("{}; nanoseconds of one core a call\n",
                           reinterpret_cast<const char*>(glGetString(GL_RENDERER)));
  const std::map<std::string, double> of_lobe = {
      {no_lobe, time_of(version, library, "")},
      {cheap_lobe, time_of(version, library, std::string(cheap_lobe) + "x = sum(lobe);")},
      {cheap_folded_lobe,
       time_of(version, library, std::string(cheap_folded_lobe) + "x = sum_folded(lobe);")}};
  for (const Measured& one : measured)
    std::cout << fmt::format(
        "{:36}{:9.2f}\n", one.name,
        time_of(version, library, std::string(one.lobe) + one.call) - of_lobe.at(one.lobe));
}

}  // namespace

int main(int count, char** arguments) {
  try {
    if (count != 5)
      throw std::runtime_error(
          "usage: ltcfit_shader_cost SHADERS TABLE.glsl FIELD.glsl FOLDED.glsl");
    run(arguments[1], arguments[2], arguments[3], arguments[4]);
  } catch (const std::exception& error) {
    std::cerr << "ltcfit_shader_cost: " << error.what() << "\n";
    return 1;
  }
  return 0;
}
