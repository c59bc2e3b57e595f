// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// Draws the four spheres of figure 14 of Aakash et al. 2022 with a table, in plain OpenGL and
// without a window:
//   ltcfit generate && ltcfit convert out/ltc.h5 -o table.dds --as stacked
//   ltcfit convert out/ltc.h5 -o table.glsl
//   ltcfit_opengl table.dds table.glsl ../../shaders/glsl spheres.png
// --mistakes draws one sphere by each mistake that docs/shading.md shows; --raw FILE also writes
// the radiances, little-endian floats from the lowest row on.
#include <EGL/egl.h>
#include <EGL/eglext.h>
#include <GLES3/gl32.h>
#include <png.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <iostream>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

namespace {

constexpr int sphere_size = 256;
constexpr int most_mistakes = 9;

struct Sphere {
  float alpha_x, alpha_y;
  int mistake;
};

std::string read_file(const std::string& name) {
  std::ifstream file(name, std::ios::binary);
  if (!file)
    throw std::runtime_error("cannot read " + name);
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

// A context without a window, on any driver that has EGL's surfaceless platform.
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

GLuint make_program(const std::string& shaders, const std::string& table) {
  const std::string version =
      "#version 300 es\nprecision highp float;\nprecision highp int;\nprecision highp sampler3D;\n";
  std::string fragment = version + read_file(shaders + "/ltc_lobe.glsl") +
                         read_file(shaders + "/ltc_table.glsl") + read_file(table) +
                         read_file(shaders + "/ltc_polygon.glsl") + read_file(SPHERES_FRAG);
  const GLuint program = glCreateProgram();
  glAttachShader(program, compile(GL_VERTEX_SHADER, version + R"(
void main() {
  gl_Position = vec4(gl_VertexID == 1 ? 3.0 : -1.0, gl_VertexID == 2 ? 3.0 : -1.0, 0.0, 1.0);
})"));
  glAttachShader(program, compile(GL_FRAGMENT_SHADER, fragment));
  glLinkProgram(program);
  glUseProgram(program);
  return program;
}

// A DDS of ltcfit's: magic and header, 128 bytes, DX10's 20, then RGBA32F; height, width and depth
// are the third, fourth and sixth number of the header.
void load_texture(const std::string& name) {
  const std::string bytes = read_file(name);
  std::uint32_t header[6] = {};
  if (bytes.size() < 148 || bytes.compare(0, 4, "DDS ") != 0)
    throw std::runtime_error(name + " is no DDS");
  std::memcpy(header, bytes.data() + 4, sizeof header);
  const std::uint32_t height = header[2], width = header[3], depth = header[5];
  if (bytes.size() != 148 + std::size_t{16} * width * height * depth)
    throw std::runtime_error(name + " is no 3-D texture of 32-bit floats: --as stacked");
  GLuint texture = 0;
  glGenTextures(1, &texture);
  glBindTexture(GL_TEXTURE_3D, texture);
  glTexImage3D(GL_TEXTURE_3D, 0, GL_RGBA32F, static_cast<GLsizei>(width),
               static_cast<GLsizei>(height), static_cast<GLsizei>(depth), 0, GL_RGBA, GL_FLOAT,
               bytes.data() + 148);
  // By texels: no filter, which not every device has for 32 bits.
  glTexParameteri(GL_TEXTURE_3D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
  glTexParameteri(GL_TEXTURE_3D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
}

struct Image {
  int width, height;
  std::vector<float> values;  // RGBA, from the lowest row on
};

Image draw(GLuint program, const std::vector<Sphere>& spheres, int columns) {
  const int count = static_cast<int>(spheres.size());
  Image image{
      sphere_size * std::min(columns, count), sphere_size * ((count + columns - 1) / columns), {}};
  GLuint target = 0, frame = 0, vertices = 0;
  glGenVertexArrays(1, &vertices);
  glBindVertexArray(vertices);
  glGenRenderbuffers(1, &target);
  glBindRenderbuffer(GL_RENDERBUFFER, target);
  glRenderbufferStorage(GL_RENDERBUFFER, GL_RGBA32F, image.width, image.height);
  glGenFramebuffers(1, &frame);
  glBindFramebuffer(GL_FRAMEBUFFER, frame);
  glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER, target);
  const auto place = [&](const char* name) { return glGetUniformLocation(program, name); };
  glUniform1f(place("size"), sphere_size);
  glUniform1f(place("f0"), 1);
  for (int i = 0; i < count; ++i) {
    const Sphere& sphere = spheres[static_cast<std::size_t>(i)];
    const int x = sphere_size * (i % columns), y = image.height - sphere_size * (1 + i / columns);
    glViewport(x, y, sphere_size, sphere_size);
    glUniform2f(place("corner"), static_cast<float>(x), static_cast<float>(y));
    glUniform2f(place("roughness"), sphere.alpha_x, sphere.alpha_y);
    glUniform1i(place("mistake"), sphere.mistake);
    glDrawArrays(GL_TRIANGLES, 0, 3);
  }
  image.values.resize(std::size_t{4} * static_cast<std::size_t>(image.width) *
                      static_cast<std::size_t>(image.height));
  glReadPixels(0, 0, image.width, image.height, GL_RGBA, GL_FLOAT, image.values.data());
  if (glGetError() != GL_NO_ERROR)
    throw std::runtime_error("OpenGL failed");
  return image;
}

// sRGB; the sphere's own dark on a darker ground.
void write_png(const Image& image, const std::string& name) {
  std::vector<png_byte> bytes;
  for (int row = image.height - 1; row >= 0; --row)
    for (int column = 0; column < image.width; ++column) {
      const float* const pixel =
          &image.values[std::size_t{4} * static_cast<std::size_t>(row * image.width + column)];
      const float linear = std::clamp(pixel[0] + 0.012f * pixel[3] + 0.004f, 0.0f, 1.0f);
      const float shown =
          linear < 0.0031308f ? 12.92f * linear : 1.055f * std::pow(linear, 1 / 2.4f) - 0.055f;
      bytes.insert(bytes.end(), 3, static_cast<png_byte>(std::lround(255 * shown)));
    }
  png_image png{};
  png.version = PNG_IMAGE_VERSION;
  png.width = static_cast<png_uint_32>(image.width);
  png.height = static_cast<png_uint_32>(image.height);
  png.format = PNG_FORMAT_RGB;
  if (!png_image_write_to_file(&png, name.c_str(), 0, bytes.data(), 0, nullptr))
    throw std::runtime_error("cannot write " + name);
}

// Each sphere against the first: the root mean square of the difference over the mean, and the
// largest, of the light.
void print_errors(const Image& image, int columns, std::size_t spheres) {
  const auto pixel = [&](std::size_t sphere, int x, int y) {
    const int i = static_cast<int>(sphere);
    const int row = image.height - sphere_size * (1 + i / columns) + y;
    return &image.values[std::size_t{4} * static_cast<std::size_t>(
                                              row * image.width + sphere_size * (i % columns) + x)];
  };
  for (std::size_t sphere = 1; sphere < spheres; ++sphere) {
    double sum = 0, squares = 0, largest = 0, count = 0;
    for (int y = 0; y < sphere_size; ++y)
      for (int x = 0; x < sphere_size; ++x) {
        const float* const right = pixel(0, x, y);
        const double off = pixel(sphere, x, y)[0] - right[0];
        sum += right[0];
        squares += off * off;
        largest = std::max(largest, std::abs(off));
        count += right[3] > 0;
      }
    std::cout << "mistake " << sphere << ": off by " << std::sqrt(squares * count) / sum * 100
              << " % of the mean, at most " << largest << " of the light\n";
  }
}

void run(std::vector<std::string> arguments) {
  std::string raw;
  std::vector<Sphere> spheres = {
      {0.05f, 0.25f, 0}, {0.5f, 0.02f, 0}, {0.5f, 0.25f, 0}, {0.5f, 1.0f, 0}};
  int columns = 4;
  for (std::size_t i = 0; i < arguments.size();)
    if (arguments[i] == "--mistakes") {
      spheres.clear();
      for (int mistake = 0; mistake <= most_mistakes; ++mistake)
        spheres.push_back({0.3f, 0.1f, mistake});
      columns = 5;
      arguments.erase(arguments.begin() + static_cast<std::ptrdiff_t>(i));
    } else if (arguments[i] == "--raw" && i + 1 < arguments.size()) {
      raw = arguments[i + 1];
      arguments.erase(arguments.begin() + static_cast<std::ptrdiff_t>(i),
                      arguments.begin() + static_cast<std::ptrdiff_t>(i) + 2);
    } else {
      ++i;
    }
  if (arguments.size() != 4)
    throw std::runtime_error(
        "usage: ltcfit_opengl TABLE.dds TABLE.glsl SHADERS OUT.png [--mistakes] "
        "[--raw FILE]");
  open_context();
  const GLuint program = make_program(arguments[2], arguments[1]);
  load_texture(arguments[0]);
  const Image image = draw(program, spheres, columns);
  write_png(image, arguments[3]);
  if (spheres.back().mistake > 0)
    print_errors(image, columns, spheres.size());
  if (!raw.empty())
    std::ofstream(raw, std::ios::binary)
        .write(reinterpret_cast<const char*>(image.values.data()),
               static_cast<std::streamsize>(4 * image.values.size()));
}

}  // namespace

int main(int count, char** arguments) {
  try {
    run({arguments + 1, arguments + count});
  } catch (const std::exception& error) {
    std::cerr << "ltcfit_opengl: " << error.what() << "\n";
    return 1;
  }
  return 0;
}
