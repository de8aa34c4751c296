// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QOpenGLFunctions_3_3_Core>
#include <QOpenGLShaderProgram>
#include <QString>

#include <array>

namespace carom {

/// One program each; resources/shaders has their sources.
enum class Pass : std::size_t {
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
};
inline constexpr std::size_t passCount = 10;

/// Where the uniform block `Frame` is bound for every program.
inline constexpr GLuint frameBinding = 0;

class Shaders {
  public:
    /// Nothing, or which shader does not compile and why.
    QString compile(QOpenGLFunctions_3_3_Core& gl);
    QOpenGLShaderProgram& use(Pass pass);

  private:
    std::array<QOpenGLShaderProgram, passCount> m_programs;
};

} // namespace carom
