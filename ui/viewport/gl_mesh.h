// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "ui/viewport/instances.h"

#include <QOpenGLBuffer>
#include <QOpenGLFunctions_3_3_Core>
#include <QOpenGLShaderProgram>
#include <QOpenGLVertexArrayObject>

#include <vector>

namespace carom {

/// A corner of a mesh in -1..1.
struct MeshVertex {
    float position[3];
    float normal[3];
};

struct MeshData {
    std::vector<MeshVertex> vertices;
    std::vector<std::uint16_t> triangles; ///< three indices each, counter-clockwise from outside
};

/// A square in the xy plane, for billboards.
MeshData squareMesh();
/// A cube with flat faces.
MeshData cubeMesh();
/// A cylinder about y with a round side and flat caps; at least three segments.
MeshData cylinderMesh(int segments);

/// A mesh on the graphics card, drawn once for each instance of a range. Needs a current context.
///
/// Its buffers hold many copies side by side, each vertex with the number of its copy, and shaders fetch the
/// instance by that number: one draw call for a few hundred bodies. Instanced calls look simpler, but a
/// software rasteriser starts its vertex stage anew for every instance, which costs ten times as much as four
/// vertices.
class GlMesh {
  public:
    void create(QOpenGLFunctions_3_3_Core& gl, const MeshData& data);
    /// With a program in use that knows resources/shaders/instance.glsl.
    void draw(QOpenGLFunctions_3_3_Core& gl, QOpenGLShaderProgram& program, InstanceRange range);

  private:
    QOpenGLVertexArrayObject m_array;
    QOpenGLBuffer m_vertices{QOpenGLBuffer::VertexBuffer};
    QOpenGLBuffer m_triangles{QOpenGLBuffer::IndexBuffer};
    int m_indexCount = 0; ///< of one copy
    int m_copies = 0;
};

} // namespace carom
