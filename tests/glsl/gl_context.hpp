#pragma once

/// A context of OpenGL without a window, on whatever EGL has: Mesa's software renderer where there is no graphics card.
/// All functions come from eglGetProcAddress, so that nothing but EGL is linked, and OpenGL ES and desktop OpenGL serve
/// alike.

#define EGL_EGLEXT_PROTOTYPES
#include <EGL/egl.h>
#include <EGL/eglext.h>
#include <GLES3/gl3.h>

#include <cstdlib>
#include <glm/vec4.hpp>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

namespace phasetree::tests {

enum class GlDialect { es_300, desktop_330 };

class GlContext {
  public:
    /// Nothing if there is no EGL that gives such a context.
    static std::optional<GlContext> make(GlDialect dialect) {
        setenv("EGL_PLATFORM", "surfaceless", 0);
        GlContext c;
        c.dialect_ = dialect;
        c.display_ = eglGetDisplay(EGL_DEFAULT_DISPLAY);
        EGLint major = 0, minor = 0;
        if (c.display_ == EGL_NO_DISPLAY || !eglInitialize(c.display_, &major, &minor)) return std::nullopt;
        const bool es = dialect == GlDialect::es_300;
        if (!eglBindAPI(es ? EGL_OPENGL_ES_API : EGL_OPENGL_API)) return std::nullopt;
        const EGLint wanted[] = {EGL_SURFACE_TYPE, 0, EGL_RENDERABLE_TYPE, es ? EGL_OPENGL_ES3_BIT : EGL_OPENGL_BIT,
                                 EGL_NONE};
        EGLConfig config = nullptr;
        EGLint count = 0;
        if (!eglChooseConfig(c.display_, wanted, &config, 1, &count)) return std::nullopt;
        const EGLint attributes[] = {EGL_CONTEXT_MAJOR_VERSION, 3, EGL_CONTEXT_MINOR_VERSION, es ? 0 : 3, EGL_NONE};
        c.context_ = eglCreateContext(c.display_, count > 0 ? config : EGL_NO_CONFIG_KHR, EGL_NO_CONTEXT, attributes);
        if (c.context_ == EGL_NO_CONTEXT) return std::nullopt;
        if (!eglMakeCurrent(c.display_, EGL_NO_SURFACE, EGL_NO_SURFACE, c.context_)) return std::nullopt;
        return c;
    }

    /// Runs a fragment shader once for each of `width` × `height` places and returns what it writes to `result`.
    /// `points` and `numbers` are textures of 32-bit floats, four to a texel: one row, and rows of 1,024.
    std::vector<glm::vec4> run(const std::string& body, const std::vector<glm::vec4>& points,
                               const std::vector<float>& numbers, int width, int height) const {
        const std::string version = dialect_ == GlDialect::es_300 ? "#version 300 es\n" : "#version 330 core\n";
        const GLuint program = link(version +
                                        "void main() { gl_Position = vec4(vec2(gl_VertexID & 1, gl_VertexID >> 1)"
                                        " * 4.0 - 1.0, 0.0, 1.0); }\n",
                                    version + body);
        const auto use = gl<decltype(&glUseProgram)>("glUseProgram");
        use(program);
        const GLuint point_texture = texture(0, GL_RGBA32F, GL_RGBA, static_cast<int>(points.size()), 1, points.data());
        const GLuint number_texture =
            texture(1, GL_RGBA32F, GL_RGBA, 1024, static_cast<int>(numbers.size() / 4096), numbers.data());
        const auto location = gl<decltype(&glGetUniformLocation)>("glGetUniformLocation");
        const auto set = gl<decltype(&glUniform1i)>("glUniform1i");
        set(location(program, "points"), 0);
        set(location(program, "phasetree_numbers"), 1);
        const GLuint target = texture(2, GL_RGBA32F, GL_RGBA, width, height, nullptr);
        GLuint frame = 0, vertices = 0;
        gl<decltype(&glGenVertexArrays)>("glGenVertexArrays")(1, &vertices);
        gl<decltype(&glBindVertexArray)>("glBindVertexArray")(vertices);
        gl<decltype(&glGenFramebuffers)>("glGenFramebuffers")(1, &frame);
        gl<decltype(&glBindFramebuffer)>("glBindFramebuffer")(GL_FRAMEBUFFER, frame);
        gl<decltype(&glFramebufferTexture2D)>("glFramebufferTexture2D")(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0,
                                                                        GL_TEXTURE_2D, target, 0);
        if (gl<decltype(&glCheckFramebufferStatus)>("glCheckFramebufferStatus")(GL_FRAMEBUFFER) !=
            GL_FRAMEBUFFER_COMPLETE)
            throw std::runtime_error("this OpenGL cannot draw into 32-bit floats");
        gl<decltype(&glViewport)>("glViewport")(0, 0, width, height);
        gl<decltype(&glDrawArrays)>("glDrawArrays")(GL_TRIANGLES, 0, 3);
        std::vector<glm::vec4> result(static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
        gl<decltype(&glReadPixels)>("glReadPixels")(0, 0, width, height, GL_RGBA, GL_FLOAT, result.data());
        const GLenum error = gl<decltype(&glGetError)>("glGetError")();
        gl<decltype(&glDeleteFramebuffers)>("glDeleteFramebuffers")(1, &frame);
        gl<decltype(&glDeleteVertexArrays)>("glDeleteVertexArrays")(1, &vertices);
        for (const GLuint t : {point_texture, number_texture, target})
            gl<decltype(&glDeleteTextures)>("glDeleteTextures")(1, &t);
        gl<decltype(&glDeleteProgram)>("glDeleteProgram")(program);
        if (error != GL_NO_ERROR) throw std::runtime_error("OpenGL error " + std::to_string(error));
        return result;
    }
    std::string renderer() const {
        return reinterpret_cast<const char*>(gl<decltype(&glGetString)>("glGetString")(GL_RENDERER));
    }

  private:
    template <class Function>
    static Function gl(const char* name) {
        const auto found = reinterpret_cast<Function>(eglGetProcAddress(name));
        if (!found) throw std::runtime_error(std::string("this OpenGL has no ") + name);
        return found;
    }
    static GLuint texture(int unit, GLint internal, GLenum format, int width, int height, const void* data) {
        GLuint name = 0;
        gl<decltype(&glGenTextures)>("glGenTextures")(1, &name);
        gl<decltype(&glActiveTexture)>("glActiveTexture")(static_cast<GLenum>(GL_TEXTURE0 + unit));
        gl<decltype(&glBindTexture)>("glBindTexture")(GL_TEXTURE_2D, name);
        const auto parameter = gl<decltype(&glTexParameteri)>("glTexParameteri");
        parameter(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
        parameter(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
        gl<decltype(&glTexImage2D)>("glTexImage2D")(GL_TEXTURE_2D, 0, internal, width, height, 0, format, GL_FLOAT,
                                                    data);
        return name;
    }
    static GLuint shader(GLenum kind, const std::string& text) {
        const GLuint name = gl<decltype(&glCreateShader)>("glCreateShader")(kind);
        const char* const start = text.c_str();
        gl<decltype(&glShaderSource)>("glShaderSource")(name, 1, &start, nullptr);
        gl<decltype(&glCompileShader)>("glCompileShader")(name);
        GLint good = 0;
        gl<decltype(&glGetShaderiv)>("glGetShaderiv")(name, GL_COMPILE_STATUS, &good);
        if (good) return name;
        std::string log(10'000, '\0');
        GLsizei length = 0;
        gl<decltype(&glGetShaderInfoLog)>("glGetShaderInfoLog")(name, 10'000, &length, log.data());
        log.resize(static_cast<std::size_t>(length));
        throw std::runtime_error(log);
    }
    static GLuint link(const std::string& vertex, const std::string& fragment) {
        const GLuint program = gl<decltype(&glCreateProgram)>("glCreateProgram")();
        const auto attach = gl<decltype(&glAttachShader)>("glAttachShader");
        const GLuint parts[] = {shader(GL_VERTEX_SHADER, vertex), shader(GL_FRAGMENT_SHADER, fragment)};
        for (const GLuint part : parts) {
            attach(program, part);
            gl<decltype(&glDeleteShader)>("glDeleteShader")(part);
        }
        gl<decltype(&glLinkProgram)>("glLinkProgram")(program);
        GLint good = 0;
        gl<decltype(&glGetProgramiv)>("glGetProgramiv")(program, GL_LINK_STATUS, &good);
        if (!good) throw std::runtime_error("the shader does not link");
        return program;
    }

    GlDialect dialect_{};
    EGLDisplay display_ = EGL_NO_DISPLAY;
    EGLContext context_ = EGL_NO_CONTEXT;
};

}  // namespace phasetree::tests
