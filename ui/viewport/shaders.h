// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QOpenGLFunctions_3_3_Core>
#include <QOpenGLShaderProgram>
#include <QString>

#include <array>

namespace carom {

/// One program each; resources/shaders has their sources.
enum class RenderPass : std::size_t {
    Sky,
    WallFace,
    WallShadow,
    Contact,
    SphereShadow,
    SphereLit,
    SphereFlat,
    MeshLit,
    MeshFlat,
    Line,
    Ribbon, ///< lines of any width
};
inline constexpr std::size_t passCount = 11;

/// What a picture may do without: a software rasteriser pays for every line of a shader, also for those
/// behind an `if` that no fragment takes.
enum class Feature : unsigned {
    None = 0,
    Shadows = 1, ///< what the shadow map darkens; walls get theirs from a pass of their own
    Pattern = 2, ///< what shows a ball's spin
    Dimmed = 4,  ///< greyed, while the text does not build
};
constexpr Feature operator|(Feature a, Feature b) {
    return static_cast<Feature>(static_cast<unsigned>(a) | static_cast<unsigned>(b));
}
constexpr Feature operator&(Feature a, Feature b) {
    return static_cast<Feature>(static_cast<unsigned>(a) & static_cast<unsigned>(b));
}
inline constexpr std::size_t featureSets = 8;

/// Where every program finds the uniform block `Frame`, the shadow map and the instances.
inline constexpr GLuint frameBinding = 0;
inline constexpr GLuint shadowUnit = 0;
inline constexpr GLuint instanceUnit = 1;

class Shaders {
  public:
    /// Nothing, or which shader does not compile and why.
    QString compile(QOpenGLFunctions_3_3_Core& gl);
    /// The program of a pass with these of its features; those that it does not know change nothing.
    QOpenGLShaderProgram& use(RenderPass pass, Feature features = Feature::None);

  private:
    QString compile(RenderPass pass, Feature features);
    QOpenGLShaderProgram& program(RenderPass pass, Feature features) {
        return m_programs[static_cast<std::size_t>(pass)][static_cast<std::size_t>(features)];
    }

    QOpenGLFunctions_3_3_Core* m_gl = nullptr;
    std::array<std::array<QOpenGLShaderProgram, featureSets>, passCount> m_programs;
};

} // namespace carom
