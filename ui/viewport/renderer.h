// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "ui/viewport/gl_mesh.h"
#include "ui/viewport/instances.h"
#include "ui/viewport/overlays.h"
#include "ui/viewport/room.h"
#include "ui/viewport/view_theme.h"

#include <QOpenGLBuffer>
#include <QOpenGLFramebufferObject>
#include <QOpenGLFunctions_3_3_Core>
#include <QOpenGLShaderProgram>
#include <QOpenGLVertexArrayObject>

#include <array>
#include <memory>
#include <span>

// Draws a scene with OpenGL 3.3 core, in an order that a software rasteriser is quick with:
//
//     shadow map of the first light   spheres as billboards, meshes, depth only
//     sky, walls                      one triangle; one buffer of polygons
//     shadows on walls                only where the shadow map reaches, multiplied on
//     contact shadows on floors       one square a sphere
//     meshes                          cylinders and cuboids, instanced
//     spheres                         one quad each, ray-cast, back to front: smooth edges by coverage
//     walls seen from behind          a breath of colour, so they never hide the scene
//     overlays                        lines; what bodies hide of them shows faintly
//     outline of the selection        by stencil, through everything
//
// All bodies come from one buffer of instances that is rewritten for every picture.

namespace carom {

/// Everything a picture needs besides the scene.
struct PictureOptions {
    PictureSize size; ///< device pixels
    Camera camera;
    ViewTheme theme;
    BodyIndex selected = noBody;
    bool dimmed = false;
    bool smooth = false; ///< several samples a pixel, for the edges of meshes: spheres are smooth without
};

class Renderer : protected QOpenGLFunctions_3_3_Core {
  public:
    /// Once, with the context current; false where OpenGL 3.3 core is missing or a shader does not compile
    /// (problem() says which).
    bool initialise();
    const QString& problem() const { return m_problem; }
    /// The processor draws: smooth pictures cost four times as much, and are for scenes at rest.
    bool isSoftware() const { return m_software; }

    /// With the context current.
    void show(const Scene& scene, const Room& room);
    /// Lines that the next pictures draw over the bodies.
    void showLines(std::span<const LineVertex> lines);
    /// Draws into the framebuffer that is bound, with the context current.
    void draw(std::span<const Pose> poses, const PictureOptions& options);
    /// Waits until everything drawn is complete.
    void finish() { glFinish(); }
    const Aabb& bounds() const { return m_table.bounds(); }

  private:
    enum Program : std::size_t {
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
        programCount
    };

    struct DepthRange {
        double nearest, furthest; ///< in front of the eye [m]
    };

    bool compile(Program program, std::initializer_list<const char*> vertex,
                 std::initializer_list<const char*> fragment);
    QOpenGLShaderProgram& use(Program program);
    void useFrame(const Camera& camera, const PictureOptions& options, const Eigen::Matrix4f& clip);
    DepthRange depthRange(const PictureOptions& options) const;
    void drawPicture(const PictureOptions& options);
    void drawShadowMap(const PictureOptions& options);
    void drawSky(const Eigen::Matrix4f& clip);
    void drawWalls(bool fromBehind);
    void drawWallShadows();
    void drawContactShadows();
    void drawBodies();
    void drawLines();
    void drawOutline(const PictureOptions& options);
    void drawRange(Program sphere, Program mesh, float growth, const InstanceRange* only);

    std::array<QOpenGLShaderProgram, programCount> m_programs;
    GlMesh m_square, m_cube, m_cylinder;
    QOpenGLBuffer m_instances{QOpenGLBuffer::VertexBuffer};
    QOpenGLBuffer m_walls{QOpenGLBuffer::VertexBuffer};
    QOpenGLBuffer m_shadowed{QOpenGLBuffer::VertexBuffer}; ///< the polygon of a wall under the shadow map
    QOpenGLBuffer m_lines{QOpenGLBuffer::VertexBuffer};
    int m_lineVertices = 0;
    QOpenGLVertexArrayObject m_lineArray, m_wallArray, m_shadowedArray, m_emptyArray;
    std::unique_ptr<QOpenGLFramebufferObject> m_smooth; ///< several samples a pixel; made when first wanted
    GLuint m_frameBuffer = 0;                           ///< the uniform block
    GLuint m_shadowTexture = 0;                         ///< depth
    GLuint m_shadowTarget = 0;                          ///< framebuffer of m_shadowTexture
    int m_wallVertices = 0;
    double m_gridSpacing = 1; ///< [m]
    Aabb m_shadowBox;         ///< what the shadow map holds, in the light's coordinates [m]
    Eigen::Matrix4f m_shadowFromWorld = Eigen::Matrix4f::Identity();
    double m_shadowTexel = 0; ///< [m]
    Room m_room;
    InstanceTable m_table;
    bool m_software = false;
    QString m_problem;
};

} // namespace carom
