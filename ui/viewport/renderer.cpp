// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/viewport/renderer.h"

#include "core/math/rotation.h"
#include "ui/widgets/resources.h"

#include <QOpenGLContext>
#include <QString>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstring>
#include <numbers>

namespace carom {

namespace {

constexpr int shadowMapSize = 1024; ///< texels along a side
constexpr int cylinderSegments = 96;
constexpr int smoothSamples = 4;
constexpr float outlineWidth = 3;       ///< [px]
constexpr float wallFromBehind = 0.05F; ///< opacity
constexpr GLuint frameBinding = 0;
/// A face counts as a floor, which shows contact shadows, within 45 degrees of level.
constexpr double floorNormalY = 0.7;

/// Towards the lights; the first stands over the left shoulder of the usual camera.
const Vec3 keyDirection = Vec3(-0.38, 0.80, 0.46).normalized();
const Vec3 fillDirection = Vec3(0.72, 0.35, -0.45).normalized();

/// Mirrors the block of resources/shaders/frame.glsl (std140: matrices and vectors of four only).
struct FrameUniforms {
    Eigen::Matrix4f clipFromWorld, shadowFromWorld;
    Eigen::Vector4f eye, forward, up, keyDirection, keyColour, fillDirection, fillColour;
    Eigen::Vector4f skyTop, skyHorizon, ground, floorTint, roomCentre, picture, accent;
};
static_assert(sizeof(FrameUniforms) == 2 * 64 + 14 * 16);

struct WallVertex {
    float position[3], normal[3], colour[3], along[2];
};

Eigen::Vector4f four(const Vec3& v, double w) {
    const Eigen::Vector3f f = v.cast<float>();
    return {f.x(), f.y(), f.z(), static_cast<float>(w)};
}

Eigen::Vector4f four(const Eigen::Vector3f& v, float w = 0) { return {v.x(), v.y(), v.z(), w}; }

/// 1, 2 or 5 times a power of ten, near x.
double roundNumber(double x) {
    const double power = std::pow(10, std::floor(std::log10(x)));
    const double digit = x / power;
    return power * (digit < 1.5 ? 1 : digit < 3.5 ? 2 : digit < 7.5 ? 5 : 10);
}

/// The first light as an orthographic camera at the origin.
Camera lightCamera() {
    Camera light;
    light.orthographic = true;
    light.fieldOfView = std::numbers::pi / 2;
    light.pitch = std::asin(keyDirection.y());
    light.yaw = std::atan2(keyDirection.x(), keyDirection.z());
    return light;
}

} // namespace

bool Renderer::compile(Program program, std::initializer_list<const char*> vertex,
                       std::initializer_list<const char*> fragment) {
    const auto source = [](std::initializer_list<const char*> files) {
        QByteArray text = "#version 330 core\n";
        for (const char* file : files)
            text += "#line 1\n" + resource(QStringLiteral("shaders/") + QLatin1StringView(file));
        return text;
    };
    QOpenGLShaderProgram& built = m_programs[program];
    if (!built.addShaderFromSourceCode(QOpenGLShader::Vertex, source(vertex)) ||
        !built.addShaderFromSourceCode(QOpenGLShader::Fragment, source(fragment)) || !built.link()) {
        m_problem = QStringLiteral("the shader %1 does not compile: %2")
                        .arg(QLatin1StringView(*(fragment.end() - 1)), built.log());
        return false;
    }
    const GLuint block = glGetUniformBlockIndex(built.programId(), "Frame");
    if (block != GL_INVALID_INDEX) glUniformBlockBinding(built.programId(), block, frameBinding);
    return true;
}

bool Renderer::initialise() {
    if (!initializeOpenGLFunctions()) {
        m_problem = QStringLiteral("this display offers no OpenGL 3.3 core");
        return false;
    }
    if (!compile(Sky, {"frame.glsl", "sky.vert"}, {"frame.glsl", "sky.frag"}) ||
        !compile(WallFace, {"frame.glsl", "light.glsl", "wall.vert"}, {"frame.glsl", "wall.frag"}) ||
        !compile(WallShadow, {"frame.glsl", "light.glsl", "wall_shadow.vert"},
                 {"frame.glsl", "light.glsl", "wall_shadow.frag"}) ||
        !compile(SphereShadow, {"frame.glsl", "instance.glsl", "sphere_shadow.vert"},
                 {"sphere_shadow.frag"}) ||
        !compile(Contact, {"frame.glsl", "instance.glsl", "contact.vert"}, {"frame.glsl", "contact.frag"}) ||
        !compile(SphereLit, {"frame.glsl", "instance.glsl", "sphere.vert"},
                 {"frame.glsl", "light.glsl", "sphere_surface.glsl", "sphere.frag"}) ||
        !compile(SphereFlat, {"frame.glsl", "instance.glsl", "sphere.vert"},
                 {"frame.glsl", "sphere_surface.glsl", "sphere_flat.frag"}) ||
        !compile(MeshLit, {"frame.glsl", "instance.glsl", "mesh.vert"},
                 {"frame.glsl", "light.glsl", "mesh.frag"}) ||
        !compile(Line, {"frame.glsl", "line.vert"}, {"line.frag"}) ||
        !compile(MeshFlat, {"frame.glsl", "instance.glsl", "mesh.vert"}, {"flat.frag"}))
        return false;

    const QByteArray device = reinterpret_cast<const char*>(glGetString(GL_RENDERER));
    m_software = device.contains("llvmpipe") || device.contains("softpipe") || device.contains("SWR");

    m_instances.create();
    m_instances.setUsagePattern(QOpenGLBuffer::StreamDraw);
    m_square.create(*this, squareMesh(), m_instances);
    m_cube.create(*this, cubeMesh(), m_instances);
    m_cylinder.create(*this, cylinderMesh(cylinderSegments), m_instances);
    m_emptyArray.create();

    m_walls.create();
    m_wallArray.create();
    const QOpenGLVertexArrayObject::Binder bound(&m_wallArray);
    m_walls.bind();
    const int sizes[] = {3, 3, 3, 2};
    std::size_t offset = 0;
    for (GLuint i = 0; i < 4; ++i) {
        glEnableVertexAttribArray(i);
        glVertexAttribPointer(i, sizes[i], GL_FLOAT, GL_FALSE, sizeof(WallVertex),
                              reinterpret_cast<const void*>(offset));
        offset += static_cast<std::size_t>(sizes[i]) * sizeof(float);
    }

    m_shadowed.create();
    m_shadowed.setUsagePattern(QOpenGLBuffer::StreamDraw);
    m_shadowedArray.create();
    {
        const QOpenGLVertexArrayObject::Binder shadowed(&m_shadowedArray);
        m_shadowed.bind();
        glEnableVertexAttribArray(0);
        glVertexAttribPointer(0, 3, GL_FLOAT, GL_FALSE, 3 * sizeof(float), nullptr);
    }

    m_lines.create();
    m_lines.setUsagePattern(QOpenGLBuffer::StreamDraw);
    m_lineArray.create();
    {
        const QOpenGLVertexArrayObject::Binder lines(&m_lineArray);
        m_lines.bind();
        glEnableVertexAttribArray(0);
        glVertexAttribPointer(0, 3, GL_FLOAT, GL_FALSE, sizeof(LineVertex), nullptr);
        glEnableVertexAttribArray(1);
        glVertexAttribPointer(1, 3, GL_FLOAT, GL_FALSE, sizeof(LineVertex),
                              reinterpret_cast<const void*>(offsetof(LineVertex, colour)));
    }

    glGenBuffers(1, &m_frameBuffer);
    glGenTextures(1, &m_shadowTexture);
    glBindTexture(GL_TEXTURE_2D, m_shadowTexture);
    glTexImage2D(GL_TEXTURE_2D, 0, GL_DEPTH_COMPONENT24, shadowMapSize, shadowMapSize, 0, GL_DEPTH_COMPONENT,
                 GL_UNSIGNED_INT, nullptr);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_COMPARE_MODE, GL_COMPARE_REF_TO_TEXTURE);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_COMPARE_FUNC, GL_LEQUAL);
    GLint outer = 0;
    glGetIntegerv(GL_DRAW_FRAMEBUFFER_BINDING, &outer);
    glGenFramebuffers(1, &m_shadowTarget);
    glBindFramebuffer(GL_FRAMEBUFFER, m_shadowTarget);
    glFramebufferTexture2D(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_TEXTURE_2D, m_shadowTexture, 0);
    glDrawBuffer(GL_NONE);
    glReadBuffer(GL_NONE);
    glBindFramebuffer(GL_FRAMEBUFFER, static_cast<GLuint>(outer));
    return true;
}

void Renderer::show(const Scene& scene, const Room& room) {
    m_table.build(scene);
    m_room = room;
    m_gridSpacing = roundNumber(room.extent / 90);
    std::vector<WallVertex> vertices;
    for (const RoomFace& face : room.faces) {
        const Tangents tangents = tangentsOf(face.wall.normal);
        const auto vertex = [&](const Vec3& corner) {
            const Eigen::Vector3f position = corner.cast<float>();
            const Eigen::Vector3f normal = face.wall.normal.cast<float>();
            const Eigen::Vector3f colour = scene.bodies[face.body].colour.cast<float>();
            WallVertex v{};
            std::copy_n(position.data(), 3, v.position);
            std::copy_n(normal.data(), 3, v.normal);
            std::copy_n(colour.data(), 3, v.colour);
            v.along[0] = static_cast<float>(tangents.first.dot(corner));
            v.along[1] = static_cast<float>(tangents.second.dot(corner));
            return v;
        };
        for (std::size_t i = 2; i < face.polygon.size(); ++i)
            for (const std::size_t corner : {std::size_t{0}, i - 1, i})
                vertices.push_back(vertex(face.polygon[corner]));
    }
    m_wallVertices = static_cast<int>(vertices.size());
    m_walls.bind();
    m_walls.allocate(vertices.data(), static_cast<int>(vertices.size() * sizeof(WallVertex)));
}

QOpenGLShaderProgram& Renderer::use(Program program) {
    m_programs[program].bind();
    return m_programs[program];
}

void Renderer::useFrame(const Camera& camera, const PictureOptions& options, const Eigen::Matrix4f& clip) {
    const ViewTheme& theme = options.theme;
    const double tangent = std::tan(camera.fieldOfView / 2);
    const double pixel = 2 * tangent / options.size.height * (camera.orthographic ? camera.distance : 1);
    FrameUniforms frame;
    frame.clipFromWorld = clip;
    frame.shadowFromWorld = m_shadowFromWorld;
    frame.eye = four(camera.eye(), camera.orthographic ? 1 : 0);
    frame.forward = four(camera.forward(), pixel);
    frame.up = four(camera.up(), static_cast<double>(theme.shadow));
    frame.keyDirection = four(keyDirection, m_shadowTexel);
    frame.keyColour = four(theme.keyLight, theme.ambient);
    frame.fillDirection = four(fillDirection, 0);
    frame.fillColour = four(theme.fillLight, theme.vignette);
    frame.skyTop = four(theme.skyTop);
    frame.skyHorizon = four(theme.skyHorizon);
    frame.ground = four(theme.ground);
    frame.floorTint = four(theme.floorTint, theme.grid);
    frame.roomCentre = four(m_room.centre, m_room.extent);
    frame.picture = {static_cast<float>(options.size.width), static_cast<float>(options.size.height),
                     static_cast<float>(m_gridSpacing), options.dimmed ? 0.75F : 0.0F};
    frame.accent = four(theme.accent);
    glBindBuffer(GL_UNIFORM_BUFFER, m_frameBuffer);
    glBufferData(GL_UNIFORM_BUFFER, sizeof frame, &frame, GL_STREAM_DRAW);
    glBindBufferBase(GL_UNIFORM_BUFFER, frameBinding, m_frameBuffer);
}

void Renderer::drawRange(Program sphere, Program mesh, float growth, const InstanceRange* only) {
    const auto part = [&](InstanceRange range) {
        if (!only) return range;
        const bool inside = only->first >= range.first && only->first < range.first + range.count;
        return inside ? *only : InstanceRange{};
    };
    const InstanceRange cylinders = part(m_table.cylinders());
    const InstanceRange cuboids = part(m_table.cuboids());
    const InstanceRange spheres = part(m_table.spheres());
    if (cylinders.count + cuboids.count > 0) {
        use(mesh).setUniformValue("growth", growth);
        glEnable(GL_CULL_FACE);
        glCullFace(GL_BACK);
        m_cylinder.draw(*this, m_instances, cylinders);
        m_cube.draw(*this, m_instances, cuboids);
        glDisable(GL_CULL_FACE);
    }
    if (spheres.count > 0) {
        use(sphere).setUniformValue("growth", growth);
        m_square.draw(*this, m_instances, spheres);
    }
}

void Renderer::drawShadowMap(const PictureOptions& options) {
    // Bodies far outside the room would take the map's texels from all others.
    Camera light = lightCamera();
    const Mat3 lightFromWorld = viewMatrix(light).block<3, 3>(0, 0);
    const Aabb reach = grown({lightFromWorld * m_room.centre, lightFromWorld * m_room.centre}, m_room.extent);
    m_shadowBox = {m_table.lightBounds().lower.cwiseMax(reach.lower),
                   m_table.lightBounds().upper.cwiseMin(reach.upper)};
    const Vec3 size = m_shadowBox.size().cwiseMax(1e-6) * (1 + 8.0 / shadowMapSize);
    const Vec3 middle = m_shadowBox.centre();
    m_shadowBox = {middle - size / 2, middle + size / 2};
    m_shadowTexel = std::max(size.x(), size.y()) / shadowMapSize;
    light.target = lightFromWorld.transpose() * middle;
    light.distance = size.y() / 2;
    PictureOptions asLight = options;
    asLight.size = {shadowMapSize * size.x() / size.y(), shadowMapSize};
    const double depth = size.z() / 2;
    const Mat4 clip = projectionMatrix(light, asLight.size, light.distance - depth, light.distance + depth) *
                      viewMatrix(light);
    Mat4 texture = Mat4::Identity();
    texture.block<3, 3>(0, 0) *= 0.5;
    texture.block<3, 1>(0, 3).setConstant(0.5);
    m_shadowFromWorld = (texture * clip).cast<float>();
    useFrame(light, asLight, clip.cast<float>());

    GLint outer = 0;
    glGetIntegerv(GL_DRAW_FRAMEBUFFER_BINDING, &outer);
    glBindFramebuffer(GL_FRAMEBUFFER, m_shadowTarget);
    glViewport(0, 0, shadowMapSize, shadowMapSize);
    glDisable(GL_BLEND);
    glEnable(GL_DEPTH_TEST);
    glDepthFunc(GL_LESS);
    glDepthMask(GL_TRUE);
    glClear(GL_DEPTH_BUFFER_BIT);
    drawRange(SphereShadow, MeshFlat, 0, nullptr);
    glBindFramebuffer(GL_FRAMEBUFFER, static_cast<GLuint>(outer));
}

void Renderer::drawSky(const Eigen::Matrix4f& clip) {
    const Eigen::Matrix4f inverse = clip.cast<double>().inverse().cast<float>();
    QOpenGLShaderProgram& program = use(Sky);
    glUniformMatrix4fv(program.uniformLocation("worldFromClip"), 1, GL_FALSE, inverse.data());
    const QOpenGLVertexArrayObject::Binder bound(&m_emptyArray);
    glDisable(GL_DEPTH_TEST);
    glDisable(GL_BLEND);
    glDrawArrays(GL_TRIANGLES, 0, 3);
}

void Renderer::drawWalls(bool fromBehind) {
    if (m_wallVertices == 0) return;
    use(WallFace).setUniformValue("opacity", fromBehind ? wallFromBehind : 1.0F);
    const QOpenGLVertexArrayObject::Binder bound(&m_wallArray);
    glDepthMask(fromBehind ? GL_FALSE : GL_TRUE);
    glEnable(GL_CULL_FACE);
    glCullFace(fromBehind ? GL_FRONT : GL_BACK);
    glEnable(GL_STENCIL_TEST);
    glStencilFunc(GL_ALWAYS, 1, 1);
    glStencilOp(GL_KEEP, GL_KEEP, fromBehind ? GL_KEEP : GL_REPLACE);
    glDrawArrays(GL_TRIANGLES, 0, m_wallVertices);
    glDisable(GL_STENCIL_TEST);
    glDisable(GL_CULL_FACE);
    glDepthMask(GL_TRUE);
}

void Renderer::drawWallShadows() {
    QOpenGLShaderProgram& program = use(WallShadow);
    const QOpenGLVertexArrayObject::Binder bound(&m_shadowedArray);
    glDepthMask(GL_FALSE);
    glBlendFuncSeparate(GL_DST_COLOR, GL_ZERO, GL_ZERO, GL_ONE);
    glEnable(GL_POLYGON_OFFSET_FILL);
    glPolygonOffset(-1, -4);
    glEnable(GL_CULL_FACE);
    const Camera light = lightCamera();
    const std::array<Wall, 4> sides = {
        Wall{light.right(), m_shadowBox.lower.x()}, Wall{-light.right(), -m_shadowBox.upper.x()},
        Wall{light.up(), m_shadowBox.lower.y()}, Wall{-light.up(), -m_shadowBox.upper.y()}};
    for (const RoomFace& face : m_room.faces) {
        if (face.wall.normal.dot(keyDirection) <= 0) continue;
        std::vector<Vec3> polygon = face.polygon;
        for (const Wall& side : sides)
            if (polygon.size() >= 3) polygon = cut(polygon, side);
        if (polygon.size() < 3) continue;
        std::vector<Eigen::Vector3f> corners;
        for (const Vec3& corner : polygon) corners.push_back(corner.cast<float>());
        m_shadowed.bind();
        m_shadowed.allocate(corners.data(), static_cast<int>(corners.size() * sizeof(Eigen::Vector3f)));
        const Eigen::Vector3f normal = face.wall.normal.cast<float>();
        program.setUniformValue("wallNormal", normal.x(), normal.y(), normal.z(), 0.0F);
        glDrawArrays(GL_TRIANGLE_FAN, 0, static_cast<GLsizei>(corners.size()));
    }
    glDisable(GL_CULL_FACE);
    glDisable(GL_POLYGON_OFFSET_FILL);
    glDepthMask(GL_TRUE);
    glBlendFuncSeparate(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA, GL_ZERO, GL_ONE);
}

void Renderer::drawContactShadows() {
    if (m_table.spheres().count == 0) return;
    QOpenGLShaderProgram& program = use(Contact);
    glDepthMask(GL_FALSE);
    glEnable(GL_POLYGON_OFFSET_FILL);
    glPolygonOffset(-1, -4);
    glEnable(GL_STENCIL_TEST); // on walls only, never on the sky beyond their edges
    glStencilFunc(GL_EQUAL, 1, 1);
    glStencilOp(GL_KEEP, GL_KEEP, GL_KEEP);
    for (const RoomFace& face : m_room.faces) {
        if (face.wall.normal.y() < floorNormalY) continue;
        const Eigen::Vector4f plane = four(face.wall.normal, face.wall.offset);
        program.setUniformValue("floorPlane", plane.x(), plane.y(), plane.z(), plane.w());
        m_square.draw(*this, m_instances, m_table.spheres());
    }
    glDisable(GL_STENCIL_TEST);
    glDisable(GL_POLYGON_OFFSET_FILL);
    glDepthMask(GL_TRUE);
}

void Renderer::drawBodies() { drawRange(SphereLit, MeshLit, 0, nullptr); }

void Renderer::showLines(std::span<const LineVertex> lines) {
    m_lineVertices = static_cast<int>(lines.size());
    m_lines.bind();
    m_lines.allocate(lines.data(), static_cast<int>(lines.size_bytes()));
}

void Renderer::drawLines() {
    if (m_lineVertices == 0) return;
    QOpenGLShaderProgram& program = use(Line);
    const QOpenGLVertexArrayObject::Binder bound(&m_lineArray);
    glDepthMask(GL_FALSE);
    glEnable(GL_DEPTH_TEST);
    program.setUniformValue("opacity", 0.95F);
    glDrawArrays(GL_LINES, 0, m_lineVertices);
    glDepthFunc(GL_GREATER);
    program.setUniformValue("opacity", 0.30F);
    glDrawArrays(GL_LINES, 0, m_lineVertices);
    glDepthFunc(GL_LEQUAL);
    glDepthMask(GL_TRUE);
}

void Renderer::drawOutline(const PictureOptions& options) {
    const int index = m_table.indexOf(options.selected);
    if (index < 0) return;
    const InstanceRange one{index, 1};
    const Eigen::Vector3f& accent = options.theme.accent;
    for (const Program program : {SphereFlat, MeshFlat})
        use(program).setUniformValue("flatColour", accent.x(), accent.y(), accent.z(), 1.0F);
    glDisable(GL_DEPTH_TEST);
    glEnable(GL_STENCIL_TEST);
    glColorMask(GL_FALSE, GL_FALSE, GL_FALSE, GL_FALSE);
    glStencilFunc(GL_ALWAYS, 2, 2);
    glStencilOp(GL_KEEP, GL_KEEP, GL_REPLACE);
    drawRange(SphereFlat, MeshFlat, 0, &one);
    glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
    glStencilFunc(GL_NOTEQUAL, 2, 2);
    glStencilOp(GL_KEEP, GL_KEEP, GL_KEEP);
    drawRange(SphereFlat, MeshFlat, outlineWidth, &one);
    glDisable(GL_STENCIL_TEST);
}

Renderer::DepthRange Renderer::depthRange(const PictureOptions& options) const {
    const Camera& camera = options.camera;
    const Vec3 eye = camera.eye();
    const Aabb& bodies = m_table.bounds();
    const double toRoom = (eye - m_room.centre).norm() + 1.5 * m_room.extent;
    const double toBodies = (bodies.centre() - eye).norm() + bodies.size().norm() / 2;
    const double furthest = 1.01 * std::max({toRoom, toBodies, camera.distance * 2});
    if (camera.orthographic) return {-furthest, furthest};

    // As near as anything can be: the digits of the depth buffer lie where the near plane is.
    double nearest = (eye - eye.cwiseMax(bodies.lower).cwiseMin(bodies.upper)).norm();
    for (const RoomFace& face : m_room.faces)
        nearest = std::min(nearest, std::abs(distanceTo(face.wall, eye)));
    const double tangent = std::tan(camera.fieldOfView / 2);
    const double slope = tangent * std::hypot(1.0, options.size.aspect());
    const double alongSight = nearest / std::hypot(1.0, slope); // in the picture's corner
    return {std::max(furthest / 20000, 0.9 * alongSight), furthest};
}

void Renderer::draw(std::span<const Pose> poses, const PictureOptions& options) {
    m_table.place(poses, options.camera, lightCamera());
    m_instances.bind();
    m_instances.allocate(m_table.all().data(), static_cast<int>(m_table.all().size_bytes()));

    drawShadowMap(options);
    if (!options.smooth) return drawPicture(options);

    GLint outer = 0;
    glGetIntegerv(GL_DRAW_FRAMEBUFFER_BINDING, &outer);
    const QSize size(static_cast<int>(options.size.width), static_cast<int>(options.size.height));
    if (!m_smooth || m_smooth->size() != size) {
        QOpenGLFramebufferObjectFormat format;
        format.setAttachment(QOpenGLFramebufferObject::CombinedDepthStencil);
        format.setSamples(smoothSamples);
        m_smooth = std::make_unique<QOpenGLFramebufferObject>(size, format);
    }
    m_smooth->bind();
    drawPicture(options);
    glBindFramebuffer(GL_READ_FRAMEBUFFER, m_smooth->handle());
    glBindFramebuffer(GL_DRAW_FRAMEBUFFER, static_cast<GLuint>(outer));
    glBlitFramebuffer(0, 0, size.width(), size.height(), 0, 0, size.width(), size.height(),
                      GL_COLOR_BUFFER_BIT, GL_NEAREST);
    glBindFramebuffer(GL_FRAMEBUFFER, static_cast<GLuint>(outer));
}

void Renderer::drawPicture(const PictureOptions& options) {
    const Camera& camera = options.camera;
    const auto [nearDepth, farDepth] = depthRange(options);
    const Eigen::Matrix4f clip =
        (projectionMatrix(camera, options.size, nearDepth, farDepth) * viewMatrix(camera)).cast<float>();
    useFrame(camera, options, clip);

    glViewport(0, 0, static_cast<GLsizei>(options.size.width), static_cast<GLsizei>(options.size.height));
    glClearStencil(0);
    glClear(GL_DEPTH_BUFFER_BIT | GL_STENCIL_BUFFER_BIT);
    glActiveTexture(GL_TEXTURE0);
    glBindTexture(GL_TEXTURE_2D, m_shadowTexture);
    glDepthFunc(GL_LEQUAL);
    // The picture stays opaque whatever is blended: alpha of what is there is kept.
    glBlendFuncSeparate(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA, GL_ZERO, GL_ONE);

    drawSky(clip);
    glEnable(GL_DEPTH_TEST);
    glEnable(GL_BLEND);
    drawWalls(false);
    drawWallShadows();
    drawContactShadows();
    drawBodies();
    drawWalls(true);
    drawLines();
    drawOutline(options);
    glDisable(GL_BLEND);
    glDisable(GL_DEPTH_TEST);
}

} // namespace carom
