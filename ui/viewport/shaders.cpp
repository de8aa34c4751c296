// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/viewport/shaders.h"

#include "ui/widgets/resources.h"

#include <QByteArray>

#include <vector>

namespace carom {

namespace {

/// The files a program is put together from, in this order: GLSL knows no includes.
struct PassRow {
    Pass pass;
    std::vector<const char*> vertex, fragment;
};

const std::array<PassRow, passCount>& passRows() {
    static const std::array<PassRow, passCount> rows = {{
        {Pass::Sky, {"frame.glsl", "sky.vert"}, {"frame.glsl", "sky.frag"}},
        {Pass::WallFace, {"frame.glsl", "light.glsl", "wall.vert"}, {"frame.glsl", "wall.frag"}},
        {Pass::WallShadow,
         {"frame.glsl", "light.glsl", "wall_shadow.vert"},
         {"frame.glsl", "light.glsl", "wall_shadow.frag"}},
        {Pass::Contact, {"frame.glsl", "instance.glsl", "contact.vert"}, {"frame.glsl", "contact.frag"}},
        {Pass::SphereShadow, {"frame.glsl", "instance.glsl", "sphere_shadow.vert"}, {"sphere_shadow.frag"}},
        {Pass::SphereLit,
         {"frame.glsl", "instance.glsl", "sphere.vert"},
         {"frame.glsl", "light.glsl", "sphere_surface.glsl", "sphere.frag"}},
        {Pass::SphereFlat,
         {"frame.glsl", "instance.glsl", "sphere.vert"},
         {"frame.glsl", "sphere_surface.glsl", "sphere_flat.frag"}},
        {Pass::MeshLit,
         {"frame.glsl", "instance.glsl", "mesh.vert"},
         {"frame.glsl", "light.glsl", "mesh.frag"}},
        {Pass::MeshFlat, {"frame.glsl", "instance.glsl", "mesh.vert"}, {"flat.frag"}},
        {Pass::Line, {"frame.glsl", "line.vert"}, {"line.frag"}},
    }};
    return rows;
}

QByteArray sourceOf(const std::vector<const char*>& files) {
    QByteArray text = "#version 330 core\n";
    for (const char* file : files)
        text += "#line 1\n" + resource(QStringLiteral("shaders/") + QLatin1StringView(file));
    return text;
}

} // namespace

QString Shaders::compile(QOpenGLFunctions_3_3_Core& gl) {
    for (const PassRow& row : passRows()) {
        QOpenGLShaderProgram& program = m_programs[static_cast<std::size_t>(row.pass)];
        if (!program.addShaderFromSourceCode(QOpenGLShader::Vertex, sourceOf(row.vertex)) ||
            !program.addShaderFromSourceCode(QOpenGLShader::Fragment, sourceOf(row.fragment)) ||
            !program.link())
            return QStringLiteral("the shader %1 does not compile: %2")
                .arg(QLatin1StringView(row.fragment.back()), program.log());
        const GLuint block = gl.glGetUniformBlockIndex(program.programId(), "Frame");
        if (block != GL_INVALID_INDEX) gl.glUniformBlockBinding(program.programId(), block, frameBinding);
    }
    return {};
}

QOpenGLShaderProgram& Shaders::use(Pass pass) {
    QOpenGLShaderProgram& program = m_programs[static_cast<std::size_t>(pass)];
    program.bind();
    return program;
}

} // namespace carom
