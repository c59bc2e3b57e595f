// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the ltcfit authors
// OpenGL and OpenGL ES through EGL, without a display: a fragment for each case.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "shaders/job.h"

#ifdef LTCFIT_HAS_EGL
#include <EGL/egl.h>
#include <EGL/eglext.h>
#include <GLES3/gl32.h>
#endif

namespace ltc::test::shaders {

std::string for_textures(const Job& job, std::string_view pattern) {
  std::string text;
  for (std::size_t i = 0; i < job.textures.size(); ++i) {
    const Texture& texture = job.textures[i];
    text += fmt::format(fmt::runtime(pattern), texture.name, i, texture.depth > 0 ? 3 : 2);
  }
  return text;
}

std::string fragment_of(const Job& job) {
  return job.glsl + for_textures(job, "uniform sampler{2}D {0};\n") + R"(uniform sampler2D asked;
uniform int which;
layout(location = 0) out vec4 answer;
vec4 input_of(int item, int i) {
  int at = 4 * item + i;
  return texelFetch(asked, ivec2(at % 4096, at / 4096), 0);
}
void main() {
  int item = int(gl_FragCoord.x) + 1024 * int(gl_FragCoord.y);
  LtcCase found = ltc_case()" +
         for_textures(job, "{0}, ") + R"(input_of(item, 0), input_of(item, 1), input_of(item, 2),
                           input_of(item, 3));
  answer = which == 0 ? found.r0 : which == 1 ? found.r1 : which == 2 ? found.r2 :
           which == 3 ? found.r3 : which == 4 ? found.r4 : found.r5;
}
)";
}

#ifdef LTCFIT_HAS_EGL
namespace {

// A context of its own, current for as long as this lives.
class Context {
 public:
  explicit Context(GlApi api) {
    const auto get_display = reinterpret_cast<PFNEGLGETPLATFORMDISPLAYEXTPROC>(
        eglGetProcAddress("eglGetPlatformDisplayEXT"));
    if (get_display)
      display_ = get_display(EGL_PLATFORM_SURFACELESS_MESA, nullptr, nullptr);
    if (display_ == EGL_NO_DISPLAY || !eglInitialize(display_, nullptr, nullptr))
      throw Missing("no EGL without a display (Mesa's surfaceless platform)");
    const bool es = api == GlApi::es;
    eglBindAPI(es ? EGL_OPENGL_ES_API : EGL_OPENGL_API);
    const EGLint of_es[] = {EGL_CONTEXT_MAJOR_VERSION, 3, EGL_CONTEXT_MINOR_VERSION, 0, EGL_NONE};
    const EGLint of_gl[] = {EGL_CONTEXT_MAJOR_VERSION,
                            4,
                            EGL_CONTEXT_MINOR_VERSION,
                            5,
                            EGL_CONTEXT_OPENGL_PROFILE_MASK,
                            EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT,
                            EGL_NONE};
    context_ = eglCreateContext(display_, EGL_NO_CONFIG_KHR, EGL_NO_CONTEXT, es ? of_es : of_gl);
    if (context_ == EGL_NO_CONTEXT ||
        !eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, context_))
      throw Missing(es ? "no OpenGL ES 3.0" : "no OpenGL 4.5");
  }
  ~Context() {
    eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
    eglDestroyContext(display_, context_);
  }
  Context(const Context&) = delete;
  Context& operator=(const Context&) = delete;

 private:
  EGLDisplay display_ = EGL_NO_DISPLAY;
  EGLContext context_ = EGL_NO_CONTEXT;
};

GLuint compiled(GLenum kind, const std::string& source) {
  const GLuint shader = glCreateShader(kind);
  const char* const text = source.c_str();
  glShaderSource(shader, 1, &text, nullptr);
  glCompileShader(shader);
  GLint done = 0;
  glGetShaderiv(shader, GL_COMPILE_STATUS, &done);
  if (!done) {
    std::string log(4096, '\0');
    GLsizei length = 0;
    glGetShaderInfoLog(shader, static_cast<GLsizei>(log.size()), &length, log.data());
    throw std::runtime_error(log.substr(0, static_cast<std::size_t>(length)));
  }
  return shader;
}

GLuint linked(const std::string& version, const std::string& fragment) {
  const GLuint program = glCreateProgram();
  glAttachShader(program, compiled(GL_VERTEX_SHADER, version + R"(
void main() {
  gl_Position = vec4(gl_VertexID == 1 ? 3.0 : -1.0, gl_VertexID == 2 ? 3.0 : -1.0, 0.0, 1.0);
}
)"));
  glAttachShader(program, compiled(GL_FRAGMENT_SHADER, version + fragment));
  glLinkProgram(program);
  GLint done = 0;
  glGetProgramiv(program, GL_LINK_STATUS, &done);
  if (!done)
    throw std::runtime_error("the program does not link");
  glUseProgram(program);
  return program;
}

void bind_texture(GLuint program, GLint unit, const Texture& texture) {
  const GLenum target = texture.depth > 0 ? GL_TEXTURE_3D : GL_TEXTURE_2D;
  GLuint name = 0;
  glGenTextures(1, &name);
  glActiveTexture(GL_TEXTURE0 + static_cast<GLenum>(unit));
  glBindTexture(target, name);
  const float* values = texture.values.data();
  for (std::uint32_t level = 0; level < texture.levels; ++level) {
    const auto w = static_cast<GLsizei>(texture.width >> level),
               h = static_cast<GLsizei>(texture.height >> level),
               d = static_cast<GLsizei>(texture.depth);
    if (texture.depth > 0)
      glTexImage3D(target, 0, GL_RGBA32F, w, h, d, 0, GL_RGBA, GL_FLOAT, values);
    else
      glTexImage2D(target, static_cast<GLint>(level), GL_RGBA32F, w, h, 0, GL_RGBA, GL_FLOAT,
                   values);
    values += std::size_t{4} * static_cast<std::size_t>(w) * static_cast<std::size_t>(h);
  }
  glTexParameteri(target, GL_TEXTURE_MAX_LEVEL, static_cast<GLint>(texture.levels) - 1);
  glTexParameteri(target, GL_TEXTURE_MIN_FILTER,
                  texture.levels > 1 ? GL_LINEAR_MIPMAP_LINEAR : GL_LINEAR);
  glTexParameteri(target, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
  for (const GLenum side : {GL_TEXTURE_WRAP_S, GL_TEXTURE_WRAP_T, GL_TEXTURE_WRAP_R})
    glTexParameteri(target, side, GL_CLAMP_TO_EDGE);
  glUniform1i(glGetUniformLocation(program, texture.name.c_str()), unit);
}

// The cases as a texture, 4096 vectors a row.
Texture asked(const Job& job) {
  Texture texture{.name = "asked", .width = 4096, .values = job.input};
  texture.height = static_cast<std::uint32_t>((job.count() * inputs + 4095) / 4096);
  texture.values.resize(std::size_t{4} * texture.width * texture.height);
  return texture;
}

}  // namespace

Results run_gl(const Job& job, GlApi api) {
  const Context context(api);
  const GLuint program =
      linked(api == GlApi::es ? "#version 300 es\nprecision highp float;\nprecision highp "
                                "int;\nprecision highp sampler2D;\nprecision highp "
                                "sampler3D;\n"
                              : "#version 450\n",
             fragment_of(job));
  GLint unit = 0;
  for (const Texture& texture : job.textures)
    bind_texture(program, unit++, texture);
  bind_texture(program, unit, asked(job));
  const auto height = static_cast<GLsizei>((job.count() + row_width - 1) / row_width);
  GLuint image = 0, frame = 0, vertices = 0;
  glActiveTexture(GL_TEXTURE15);
  glGenTextures(1, &image);
  glBindTexture(GL_TEXTURE_2D, image);
  glTexStorage2D(GL_TEXTURE_2D, 1, GL_RGBA32F, row_width, height);
  glGenFramebuffers(1, &frame);
  glBindFramebuffer(GL_FRAMEBUFFER, frame);
  glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, image, 0);
  if (glCheckFramebufferStatus(GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE)
    throw Missing("no rendering to floats");
  glGenVertexArrays(1, &vertices);
  glBindVertexArray(vertices);
  glViewport(0, 0, row_width, height);
  Results results(job.count() * outputs * 4);
  std::vector<float> pixels(std::size_t{4} * row_width * static_cast<std::size_t>(height));
  for (std::size_t which = 0; which < outputs; ++which) {
    glUniform1i(glGetUniformLocation(program, "which"), static_cast<GLint>(which));
    glDrawArrays(GL_TRIANGLES, 0, 3);
    glReadPixels(0, 0, row_width, height, GL_RGBA, GL_FLOAT, pixels.data());
    for (std::size_t i = 0; i < job.count(); ++i)
      std::copy_n(pixels.begin() + static_cast<std::ptrdiff_t>(4 * i), 4,
                  results.begin() + static_cast<std::ptrdiff_t>(4 * (outputs * i + which)));
  }
  if (const GLenum error = glGetError(); error != GL_NO_ERROR)
    throw std::runtime_error("OpenGL error " + std::to_string(error));
  return results;
}
#else
Results run_gl(const Job&, GlApi) {
  throw Missing("built without EGL: libegl-dev, libgles-dev");
}
#endif

}  // namespace ltc::test::shaders
