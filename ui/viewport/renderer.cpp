// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/viewport/renderer.h"

#include "core/math/rotation.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <utility>

namespace carom {

namespace {

constexpr int smoothSamples = 4;  ///< a pixel, against jagged edges; twice as many take about twice the time
constexpr float outlineWidth = 3; ///< [px]
constexpr float wallFromBehind = 0.05F; ///< opacity
constexpr float hiddenLine = 0.30F;     ///< opacity of what bodies hide of an overlay
/// A face counts as a floor, which shows contact shadows, within 45 degrees of level.
constexpr double floorNormalY = 0.7;

/// Attributes of wall.vert.
struct WallVertex {
    float position[3], normal[3], colour[3], along[2];
};

/// Attributes of line.vert.
struct FineVertex {
    float position[3], colour[3];
};

/// Attributes of ribbon.vert.
struct RibbonVertex {
    float position[3], other[3], colour[3], side;
};

FineVertex fineVertex(const LineVertex& from) {
    FineVertex made{};
    std::copy_n(from.position, 3, made.position);
    std::copy_n(from.colour, 3, made.colour);
    return made;
}

RibbonVertex ribbonVertex(const LineVertex& from, const LineVertex& to, float side) {
    RibbonVertex made{};
    std::copy_n(from.position, 3, made.position);
    std::copy_n(to.position, 3, made.other);
    std::copy_n(from.colour, 3, made.colour);
    made.side = side;
    return made;
}

/// The next root of a power of two, so that the depths of a picture do not change with every step of a body.
double roundedUp(double x) { return std::exp2(std::ceil(2 * std::log2(x)) / 2); }
double roundedDown(double x) { return std::exp2(std::floor(2 * std::log2(x)) / 2); }

void copy(const Vec3& from, float (&to)[3]) {
    for (int axis = 0; axis < 3; ++axis) to[axis] = static_cast<float>(from[axis]);
}

} // namespace

QSurfaceFormat Renderer::format() {
    QSurfaceFormat format;
    format.setVersion(3, 3);
    format.setProfile(QSurfaceFormat::CoreProfile);
    return format;
}

bool Renderer::initialise() {
    if (!initializeOpenGLFunctions())
        m_problem = QStringLiteral("this display offers no OpenGL 3.3 core");
    else
        m_problem = m_shaders.compile(*this);
    if (!m_problem.isEmpty()) return false;

    const QByteArray device = reinterpret_cast<const char*>(glGetString(GL_RENDERER));
    m_software = device.contains("llvmpipe") || device.contains("softpipe") || device.contains("SWR");

    m_instances.create();
    m_instances.setUsagePattern(QOpenGLBuffer::StreamDraw);
    m_instances.bind();
    glGenTextures(1, &m_instanceTexture);
    glBindTexture(GL_TEXTURE_BUFFER, m_instanceTexture);
    glTexBuffer(GL_TEXTURE_BUFFER, GL_RGBA32F, m_instances.bufferId());
    m_square.create(*this, squareMesh());
    m_cube.create(*this, cubeMesh());
    for (std::size_t detail = 0; detail < detailCount; ++detail)
        m_cylinders[detail].create(*this, cylinderMesh(detailSegments[detail]));
    m_walls.create(*this, {3, 3, 3, 2});
    m_shadowed.create(*this, {3});
    m_lines.create(*this, {3, 3});
    m_wideLines.create(*this, {3, 3, 3, 1});
    m_marks.create(*this, {3, 3, 3, 1});
    m_noVertices.create();
    glGenBuffers(1, &m_frameBuffer);
    createShadowMap();
    return true;
}

void Renderer::createShadowMap() {
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
}

void Renderer::show(const Stage& stage) {
    static const Scene nothing;
    const Scene& scene = stage.pipeline ? stage.pipeline->scene() : nothing;
    m_table.build(scene);
    m_room = stage.room;
    m_backdropFrame.picture.setZero(); // other walls
    std::vector<WallVertex> vertices;
    for (const RoomFace& face : m_room.faces) {
        const Tangents tangents = tangentsOf(face.wall.normal);
        const auto vertex = [&](const Vec3& corner) {
            WallVertex v{};
            copy(corner, v.position);
            copy(face.wall.normal, v.normal);
            copy(scene.bodies[face.body].colour, v.colour);
            v.along[0] = static_cast<float>(tangents.first.dot(corner));
            v.along[1] = static_cast<float>(tangents.second.dot(corner));
            return v;
        };
        for (std::size_t i = 2; i < face.polygon.size(); ++i)
            for (const std::size_t corner : {std::size_t{0}, i - 1, i})
                vertices.push_back(vertex(face.polygon[corner]));
    }
    m_walls.upload<WallVertex>(vertices);
}

void Renderer::useFrame(const FrameUniforms& frame) {
    glBindBuffer(GL_UNIFORM_BUFFER, m_frameBuffer);
    glBufferData(GL_UNIFORM_BUFFER, sizeof frame, &frame, GL_STREAM_DRAW);
    glBindBufferBase(GL_UNIFORM_BUFFER, frameBinding, m_frameBuffer);
}

void Renderer::draw(const PictureJob& job) {
    const PictureOptions& options = job.options;
    if (std::exchange(m_stage, job.stage) != job.stage) show(*m_stage);
    if (std::exchange(m_shownLines, job.lines) != job.lines) takeLines(*m_shownLines);
    m_table.place(job.poses(), options.camera, options.size, lightCamera());
    m_instances.bind();
    m_instances.allocate(m_table.all().data(), static_cast<int>(m_table.all().size_bytes()));
    glActiveTexture(GL_TEXTURE0 + instanceUnit);
    glBindTexture(GL_TEXTURE_BUFFER, m_instanceTexture);

    drawShadowMap(options);
    if (options.smooth)
        drawSmoothly(options);
    else
        drawPicture(options);
}

void Renderer::drawSmoothly(const PictureOptions& options) {
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
    glEnable(GL_MULTISAMPLE); // QPainter turns it off
    drawPicture(options);
    glBindFramebuffer(GL_READ_FRAMEBUFFER, m_smooth->handle());
    glBindFramebuffer(GL_DRAW_FRAMEBUFFER, static_cast<GLuint>(outer));
    glBlitFramebuffer(0, 0, size.width(), size.height(), 0, 0, size.width(), size.height(),
                      GL_COLOR_BUFFER_BIT, GL_NEAREST);
    glBindFramebuffer(GL_FRAMEBUFFER, static_cast<GLuint>(outer));
}

void Renderer::drawPicture(const PictureOptions& options) {
    const auto [nearest, furthest] = depthRange(options);
    const Mat4 clipFromWorld =
        projectionMatrix(options.camera, options.size, nearest, furthest) * viewMatrix(options.camera);
    const FrameUniforms frame = frameUniforms(options, clipFromWorld, m_shadow, m_room);
    useFrame(frame);

    glViewport(0, 0, static_cast<GLsizei>(options.size.width), static_cast<GLsizei>(options.size.height));
    glDepthFunc(GL_LEQUAL);
    // The picture stays opaque whatever is blended: alpha of what is there is kept.
    glBlendFuncSeparate(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA, GL_ZERO, GL_ONE);

    const Feature features = featuresOf(options);
    const Backdrop backdrop{frame, clipFromWorld, features};
    if (options.smooth || !copyBackdrop(backdrop)) drawBackdrop(backdrop);
    glActiveTexture(GL_TEXTURE0 + shadowUnit); // making a framebuffer lets it go
    glBindTexture(GL_TEXTURE_2D, m_shadowTexture);
    if (options.shadows) {
        drawWallShadows();
        drawContactShadows();
    }
    drawBodies(RenderPass::SphereLit, RenderPass::MeshLit, {.features = features});
    drawWalls(true, features);
    drawLines();
    drawRibbons(options.lineWidth);
    drawOutline(options);
    glDisable(GL_BLEND);
    glDisable(GL_DEPTH_TEST);
}

void Renderer::drawBackdrop(const Backdrop& backdrop) {
    glClearStencil(0);
    glClear(GL_DEPTH_BUFFER_BIT | GL_STENCIL_BUFFER_BIT);
    drawSky(backdrop.clipFromWorld);
    glEnable(GL_DEPTH_TEST);
    glEnable(GL_BLEND);
    drawWalls(false, backdrop.features);
}

bool Renderer::copyBackdrop(const Backdrop& backdrop) {
    FrameUniforms seen = backdrop.frame;
    seen.shadowFromWorld.setZero(); // bodies move it, and neither sky nor walls look at it
    seen.keyDirection.w() = 0;
    if (std::memcmp(&seen, &m_backdropFrame, sizeof seen) != 0) {
        m_backdropFrame = seen; // worth keeping if the next picture looks the same way
        m_backdropDrawn = false;
        return false;
    }
    GLint outer = 0;
    glGetIntegerv(GL_DRAW_FRAMEBUFFER_BINDING, &outer);
    const QSize size(static_cast<int>(seen.picture.x()), static_cast<int>(seen.picture.y()));
    if (!m_backdropDrawn) {
        if (!m_backdrop || m_backdrop->size() != size)
            m_backdrop = std::make_unique<QOpenGLFramebufferObject>(
                size, QOpenGLFramebufferObject::CombinedDepthStencil);
        m_backdrop->bind();
        drawBackdrop(backdrop);
        m_backdropDrawn = true;
    }
    glBindFramebuffer(GL_READ_FRAMEBUFFER, m_backdrop->handle());
    glBindFramebuffer(GL_DRAW_FRAMEBUFFER, static_cast<GLuint>(outer));
    glBlitFramebuffer(0, 0, size.width(), size.height(), 0, 0, size.width(), size.height(),
                      GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT | GL_STENCIL_BUFFER_BIT, GL_NEAREST);
    glBindFramebuffer(GL_FRAMEBUFFER, static_cast<GLuint>(outer));
    glEnable(GL_DEPTH_TEST);
    glEnable(GL_BLEND);
    return true;
}

Feature Renderer::featuresOf(const PictureOptions& options) const {
    return (options.shadows ? Feature::Shadows : Feature::None) |
           (m_table.anySpins() ? Feature::Pattern : Feature::None) |
           (options.dimmed ? Feature::Dimmed : Feature::None);
}

Renderer::DepthRange Renderer::depthRange(const PictureOptions& options) const {
    const Camera& camera = options.camera;
    const Vec3 eye = camera.eye();
    const Aabb& bodies = m_table.bounds();
    const double toRoom = (eye - m_room.centre).norm() + 1.5 * m_room.extent;
    const double toBodies = (bodies.centre() - eye).norm() + bodies.size().norm() / 2;
    const double furthest = roundedUp(1.01 * std::max({toRoom, toBodies, camera.distance * 2}));
    if (camera.orthographic) return {-furthest, furthest};

    // As near as anything can be: the digits of the depth buffer lie where the near plane is.
    double nearest = (eye - eye.cwiseMax(bodies.lower).cwiseMin(bodies.upper)).norm();
    for (const RoomFace& face : m_room.faces)
        nearest = std::min(nearest, std::abs(distanceTo(face.wall, eye)));
    const double tangent = std::tan(camera.fieldOfView / 2);
    const double slope = tangent * std::hypot(1.0, options.size.aspect());
    const double alongSight = nearest / std::hypot(1.0, slope); // in the picture's corner
    return {roundedDown(std::max(furthest / 20000, 0.9 * alongSight)), furthest};
}

void Renderer::drawShadowMap(const PictureOptions& options) {
    m_shadow = shadowView(m_table.lightBounds(), options.camera, m_room);
    PictureOptions asLight = options;
    asLight.camera = m_shadow.camera;
    asLight.size = m_shadow.size;
    useFrame(frameUniforms(asLight, m_shadow.clipFromWorld, m_shadow, m_room));

    GLint outer = 0;
    glGetIntegerv(GL_DRAW_FRAMEBUFFER_BINDING, &outer);
    glBindFramebuffer(GL_FRAMEBUFFER, m_shadowTarget);
    glViewport(0, 0, shadowMapSize, shadowMapSize);
    glDisable(GL_BLEND);
    glEnable(GL_DEPTH_TEST);
    glDepthFunc(GL_LESS);
    glDepthMask(GL_TRUE);
    glClear(GL_DEPTH_BUFFER_BIT);
    if (options.shadows)
        drawBodies(RenderPass::SphereShadow, RenderPass::MeshFlat, {}); // else everything is in the light
    glBindFramebuffer(GL_FRAMEBUFFER, static_cast<GLuint>(outer));
}

void Renderer::drawSky(const Mat4& clipFromWorld) {
    const Eigen::Matrix4f inverse = clipFromWorld.inverse().cast<float>();
    QOpenGLShaderProgram& program = m_shaders.use(RenderPass::Sky);
    glUniformMatrix4fv(program.uniformLocation("worldFromClip"), 1, GL_FALSE, inverse.data());
    const QOpenGLVertexArrayObject::Binder bound(&m_noVertices);
    glDisable(GL_DEPTH_TEST);
    glDisable(GL_BLEND);
    glDrawArrays(GL_TRIANGLES, 0, 3);
}

void Renderer::drawWalls(bool fromBehind, Feature features) {
    if (m_walls.isEmpty()) return;
    m_shaders.use(RenderPass::WallFace, features)
        .setUniformValue("opacity", fromBehind ? wallFromBehind : 1.0F);
    glDepthMask(fromBehind ? GL_FALSE : GL_TRUE);
    glEnable(GL_CULL_FACE);
    glCullFace(fromBehind ? GL_FRONT : GL_BACK);
    glEnable(GL_STENCIL_TEST);
    glStencilFunc(GL_ALWAYS, 1, 1);
    glStencilOp(GL_KEEP, GL_KEEP, fromBehind ? GL_KEEP : GL_REPLACE);
    m_walls.draw(*this, GL_TRIANGLES);
    glDisable(GL_STENCIL_TEST);
    glDisable(GL_CULL_FACE);
    glDepthMask(GL_TRUE);
}

void Renderer::drawWallShadows() {
    QOpenGLShaderProgram& program = m_shaders.use(RenderPass::WallShadow);
    glDepthMask(GL_FALSE);
    glBlendFuncSeparate(GL_DST_COLOR, GL_ZERO, GL_ZERO, GL_ONE);
    glEnable(GL_POLYGON_OFFSET_FILL);
    glPolygonOffset(-1, -4);
    glEnable(GL_CULL_FACE);
    for (const RoomFace& face : m_room.faces) {
        if (face.wall.normal.dot(keyDirection()) <= 0) continue;
        std::vector<Vec3> polygon = face.polygon;
        for (const Wall& side : m_shadow.sides)
            if (polygon.size() >= 3) polygon = cut(polygon, side);
        if (polygon.size() < 3) continue;
        std::vector<Eigen::Vector3f> corners;
        for (const Vec3& corner : polygon) corners.push_back(corner.cast<float>());
        m_shadowed.upload<Eigen::Vector3f>(corners);
        const Eigen::Vector3f normal = face.wall.normal.cast<float>();
        program.setUniformValue("wallNormal", normal.x(), normal.y(), normal.z(), 0.0F);
        m_shadowed.draw(*this, GL_TRIANGLE_FAN);
    }
    glDisable(GL_CULL_FACE);
    glDisable(GL_POLYGON_OFFSET_FILL);
    glDepthMask(GL_TRUE);
    glBlendFuncSeparate(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA, GL_ZERO, GL_ONE);
}

void Renderer::drawContactShadows() {
    if (m_table.spheres().count == 0) return;
    QOpenGLShaderProgram& program = m_shaders.use(RenderPass::Contact);
    glDepthMask(GL_FALSE);
    glEnable(GL_POLYGON_OFFSET_FILL);
    glPolygonOffset(-1, -4);
    glEnable(GL_STENCIL_TEST); // on walls only, never on the sky beyond their edges
    glStencilFunc(GL_EQUAL, 1, 1);
    glStencilOp(GL_KEEP, GL_KEEP, GL_KEEP);
    for (const RoomFace& face : m_room.faces) {
        if (face.wall.normal.y() < floorNormalY) continue;
        const Eigen::Vector3f normal = face.wall.normal.cast<float>();
        program.setUniformValue("floorPlane", normal.x(), normal.y(), normal.z(),
                                static_cast<float>(face.wall.offset));
        m_square.draw(*this, program, m_table.spheres());
    }
    glDisable(GL_STENCIL_TEST);
    glDisable(GL_POLYGON_OFFSET_FILL);
    glDepthMask(GL_TRUE);
}

void Renderer::drawBodies(RenderPass spheres, RenderPass meshes, const BodyStyle& style) {
    const auto part = [&style](InstanceRange range) {
        if (style.instance == everyInstance) return range;
        const bool inside = style.instance >= range.first && style.instance < range.first + range.count;
        return inside ? InstanceRange{style.instance, 1} : InstanceRange{};
    };
    QOpenGLShaderProgram& mesh = m_shaders.use(meshes, style.features);
    mesh.setUniformValue("growth", style.growth);
    glEnable(GL_CULL_FACE);
    glCullFace(GL_BACK);
    for (std::size_t detail = 0; detail < detailCount; ++detail)
        m_cylinders[detail].draw(*this, mesh, part(m_table.cylinders(static_cast<Detail>(detail))));
    m_cube.draw(*this, mesh, part(m_table.cuboids()));
    glDisable(GL_CULL_FACE);
    QOpenGLShaderProgram& sphere = m_shaders.use(spheres, style.features);
    sphere.setUniformValue("growth", style.growth);
    m_square.draw(*this, sphere, part(m_table.spheres()));
}

/// Fine lines are OpenGL's own; it knows no wider ones, so those are bands of two triangles.
void Renderer::takeLines(std::span<const LineVertex> lines) {
    std::vector<FineVertex> fine;
    std::vector<RibbonVertex> wide, marks;
    for (std::size_t i = 0; i + 1 < lines.size(); i += 2) {
        const LineVertex &from = lines[i], &to = lines[i + 1];
        if (from.kind == LineKind::Fine) {
            fine.push_back(fineVertex(from));
            fine.push_back(fineVertex(to));
            continue;
        }
        std::vector<RibbonVertex>& ribbons = from.kind == LineKind::Mark ? marks : wide;
        const RibbonVertex corners[] = {ribbonVertex(from, to, 1), ribbonVertex(from, to, -1),
                                        ribbonVertex(to, from, -1), ribbonVertex(to, from, 1)};
        for (const int corner : {0, 1, 2, 1, 3, 2}) ribbons.push_back(corners[corner]);
    }
    m_lines.upload<FineVertex>(fine);
    m_wideLines.upload<RibbonVertex>(wide);
    m_marks.upload<RibbonVertex>(marks);
}

void Renderer::drawRibbons(double width) {
    if (m_wideLines.isEmpty() && m_marks.isEmpty()) return;
    QOpenGLShaderProgram& program = m_shaders.use(RenderPass::Ribbon);
    program.setUniformValue("halfWidth", static_cast<float>(width / 2));
    program.setUniformValue("opacity", 1.0F);
    glDepthMask(GL_FALSE);
    m_wideLines.draw(*this, GL_TRIANGLES);
    glDisable(GL_DEPTH_TEST);
    m_marks.draw(*this, GL_TRIANGLES);
    glEnable(GL_DEPTH_TEST);
    glDepthMask(GL_TRUE);
}

void Renderer::drawLines() {
    if (m_lines.isEmpty()) return;
    QOpenGLShaderProgram& program = m_shaders.use(RenderPass::Line);
    glDepthMask(GL_FALSE);
    program.setUniformValue("opacity", 1.0F);
    m_lines.draw(*this, GL_LINES);
    glDepthFunc(GL_GREATER);
    program.setUniformValue("opacity", hiddenLine);
    m_lines.draw(*this, GL_LINES);
    glDepthFunc(GL_LEQUAL);
    glDepthMask(GL_TRUE);
}

void Renderer::drawOutline(const PictureOptions& options) {
    const int index = m_table.indexOf(options.selected);
    if (index < 0) return;
    const Eigen::Vector3f& accent = options.theme.accent;
    for (const RenderPass pass : {RenderPass::SphereFlat, RenderPass::MeshFlat})
        m_shaders.use(pass).setUniformValue("flatColour", accent.x(), accent.y(), accent.z(), 1.0F);
    glDisable(GL_DEPTH_TEST);
    glEnable(GL_STENCIL_TEST);
    glColorMask(GL_FALSE, GL_FALSE, GL_FALSE, GL_FALSE);
    glStencilFunc(GL_ALWAYS, 2, 2);
    glStencilOp(GL_KEEP, GL_KEEP, GL_REPLACE);
    drawBodies(RenderPass::SphereFlat, RenderPass::MeshFlat, {.instance = index});
    glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
    glStencilFunc(GL_NOTEQUAL, 2, 2);
    glStencilOp(GL_KEEP, GL_KEEP, GL_KEEP);
    drawBodies(RenderPass::SphereFlat, RenderPass::MeshFlat, {.growth = outlineWidth, .instance = index});
    glDisable(GL_STENCIL_TEST);
}

} // namespace carom
