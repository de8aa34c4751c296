// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/viewport/shaders.h"

#include "ui/widgets/resources.h"

#include <QByteArray>

#include <utility>
#include <vector>

namespace carom {

namespace {

/// The files a program is put together from, in this order: GLSL knows no includes.
struct PassRow {
    RenderPass pass;
    std::vector<const char*> vertex, fragment;
    Feature features = Feature::None; ///< those it can be had with and without
};

const std::array<PassRow, passCount>& passRows() {
    static const std::array<PassRow, passCount> passes = {{
        {RenderPass::Sky, {"frame.glsl", "sky.vert"}, {"frame.glsl", "sky.frag"}},
        {RenderPass::WallFace,
         {"frame.glsl", "light.glsl", "wall.vert"},
         {"frame.glsl", "wall.frag"},
         Feature::Dimmed},
        {RenderPass::WallShadow,
         {"frame.glsl", "light.glsl", "wall_shadow.vert"},
         {"frame.glsl", "light.glsl", "wall_shadow.frag"}},
        {RenderPass::Contact,
         {"frame.glsl", "instance.glsl", "contact.vert"},
         {"frame.glsl", "contact.frag"}},
        {RenderPass::SphereShadow,
         {"frame.glsl", "instance.glsl", "sphere_shadow.vert"},
         {"sphere_shadow.frag"}},
        {RenderPass::SphereLit,
         {"frame.glsl", "instance.glsl", "sphere.vert"},
         {"frame.glsl", "light.glsl", "sphere_surface.glsl", "sphere.frag"},
         Feature::Shadows | Feature::Pattern | Feature::Dimmed},
        {RenderPass::SphereFlat,
         {"frame.glsl", "instance.glsl", "sphere.vert"},
         {"frame.glsl", "sphere_surface.glsl", "sphere_flat.frag"}},
        {RenderPass::MeshLit,
         {"frame.glsl", "instance.glsl", "mesh.vert"},
         {"frame.glsl", "light.glsl", "mesh.frag"},
         Feature::Shadows | Feature::Dimmed},
        {RenderPass::MeshFlat, {"frame.glsl", "instance.glsl", "mesh.vert"}, {"flat.frag"}},
        {RenderPass::Line, {"frame.glsl", "line.vert"}, {"line.frag"}},
        {RenderPass::Ribbon, {"frame.glsl", "ribbon.vert"}, {"line.frag"}},
    }};
    return passes;
}

QByteArray sourceOf(const std::vector<const char*>& files, Feature features) {
    QByteArray text = "#version 330 core\n";
    for (const auto& [feature, define] : {std::pair{Feature::Shadows, "#define SHADOWS\n"},
                                          {Feature::Pattern, "#define PATTERN\n"},
                                          {Feature::Dimmed, "#define DIMMED\n"}})
        if ((features & feature) != Feature::None) text += define;
    for (const char* file : files)
        text += "#line 1\n" + resource(QStringLiteral("shaders/") + QLatin1StringView(file));
    return text;
}

} // namespace

QString Shaders::compile(QOpenGLFunctions_3_3_Core& gl) {
    m_gl = &gl;
    for (const PassRow& row : passRows())
        if (const QString problem = compile(row.pass, row.features); !problem.isEmpty()) return problem;
    return {};
}

QString Shaders::compile(RenderPass pass, Feature features) {
    const PassRow& row = passRows()[static_cast<std::size_t>(pass)];
    QOpenGLShaderProgram& made = program(pass, features);
    if (!made.addShaderFromSourceCode(QOpenGLShader::Vertex, sourceOf(row.vertex, features)) ||
        !made.addShaderFromSourceCode(QOpenGLShader::Fragment, sourceOf(row.fragment, features)) ||
        !made.link())
        return QStringLiteral("the shader %1 does not compile: %2")
            .arg(QLatin1StringView(row.fragment.back()), made.log());
    const GLuint block = m_gl->glGetUniformBlockIndex(made.programId(), "Frame");
    if (block != GL_INVALID_INDEX) m_gl->glUniformBlockBinding(made.programId(), block, frameBinding);
    made.bind();
    made.setUniformValue("shadowMap", shadowUnit);
    made.setUniformValue("instances", instanceUnit);
    return {};
}

QOpenGLShaderProgram& Shaders::use(RenderPass pass, Feature features) {
    const Feature known = passRows()[static_cast<std::size_t>(pass)].features;
    features = features & known;
    if (!program(pass, features).isLinked() && !compile(pass, features).isEmpty()) features = known;
    QOpenGLShaderProgram& used = program(pass, features);
    used.bind();
    return used;
}

} // namespace carom
