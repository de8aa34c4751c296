// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "ui/viewport/gl_mesh.h"
#include "ui/viewport/gl_stream.h"
#include "ui/viewport/instances.h"
#include "ui/viewport/lighting.h"
#include "ui/viewport/overlays.h"
#include "ui/viewport/picture_job.h"
#include "ui/viewport/room.h"
#include "ui/viewport/shaders.h"

#include <QOpenGLBuffer>
#include <QOpenGLFramebufferObject>
#include <QOpenGLFunctions_3_3_Core>
#include <QOpenGLVertexArrayObject>
#include <QSurfaceFormat>

#include <memory>
#include <span>

// Draws a scene with OpenGL 3.3 core, in an order that a software rasteriser is quick with:
//
//     shadow map of the first light   spheres as billboards, meshes, depth only
//     sky, walls                      one triangle; one buffer of polygons; copied while the camera rests
//     shadows on walls                only where the shadow map reaches, multiplied on
//     contact shadows on floors       one square a sphere
//     meshes                          cylinders and cuboids
//     spheres                         one quad each, ray-cast, back to front: smooth edges by coverage
//     walls seen from behind          a breath of colour, so they never hide the scene
//     overlays                        lines; what bodies hide of them shows faintly, but for marks
//     outline of the selection        by stencil, through everything
//
// All bodies come from one buffer of instances that is rewritten for every picture.

namespace carom {

class Renderer : protected QOpenGLFunctions_3_3_Core {
  public:
    /// That a context must have.
    static QSurfaceFormat format();

    /// Once, with the context current; false where OpenGL 3.3 core is missing or a shader does not compile
    /// (problem() says which).
    bool initialise();
    const QString& problem() const { return m_problem; }
    /// The processor draws: smooth pictures cost four times as much, and are for scenes at rest.
    bool isSoftware() const { return m_software; }

    /// Draws into the framebuffer that is bound, with the context current.
    void draw(const PictureJob& job);
    /// Waits until everything drawn is complete.
    void finish() { glFinish(); }

  private:
    struct DepthRange {
        double nearest, furthest; ///< in front of the eye [m]
    };
    /// Sky and walls, and all they depend on: while the camera stands still they are drawn once.
    struct Backdrop {
        const FrameUniforms& frame;
        const Mat4& clipFromWorld;
        Feature features;
    };
    static constexpr int everyInstance = -1;
    struct BodyStyle {
        Feature features = Feature::None;
        float growth = 0;             ///< [px]
        int instance = everyInstance; ///< or only this one
    };

    void createShadowMap();
    void show(const Stage& stage);
    void useFrame(const FrameUniforms& frame);
    DepthRange depthRange(const PictureOptions& options) const;
    void drawShadowMap(const PictureOptions& options);
    void drawSmoothly(const PictureOptions& options);
    void drawPicture(const PictureOptions& options);
    void drawBackdrop(const Backdrop& backdrop);
    /// Where the picture before had the same one; false where it must be drawn.
    bool copyBackdrop(const Backdrop& backdrop);
    void drawSky(const Mat4& clipFromWorld);
    void drawWalls(bool fromBehind, Feature features);
    void drawWallShadows();
    void drawContactShadows();
    void takeLines(std::span<const LineVertex> lines);
    void drawLines();
    void drawRibbons(double width);
    void drawOutline(const PictureOptions& options);
    void drawBodies(RenderPass spheres, RenderPass meshes, const BodyStyle& style);
    Feature featuresOf(const PictureOptions& options) const;

    Shaders m_shaders;
    GlMesh m_square, m_cube;
    std::array<GlMesh, detailCount> m_cylinders;
    QOpenGLBuffer m_instances{QOpenGLBuffer::VertexBuffer};
    GLuint m_instanceTexture = 0; ///< shaders read m_instances through it
    GlStream m_walls, m_lines;
    GlStream m_wideLines, m_marks;
    GlStream m_shadowed; ///< the polygon of a wall under the shadow map
    QOpenGLVertexArrayObject m_noVertices;
    std::unique_ptr<QOpenGLFramebufferObject> m_smooth; ///< several samples a pixel; made when first wanted
    std::unique_ptr<QOpenGLFramebufferObject> m_backdrop;
    FrameUniforms m_backdropFrame{}; ///< that m_backdrop is for
    bool m_backdropDrawn = false;
    GLuint m_frameBuffer = 0;   ///< the uniform block
    GLuint m_shadowTexture = 0; ///< depth
    GLuint m_shadowTarget = 0;  ///< framebuffer of m_shadowTexture
    ShadowView m_shadow;
    Room m_room;
    InstanceTable m_table;
    std::shared_ptr<const Stage> m_stage; ///< that m_table, m_room and m_walls are of
    std::shared_ptr<const std::vector<LineVertex>> m_shownLines;
    bool m_software = false;
    QString m_problem;
};

} // namespace carom
