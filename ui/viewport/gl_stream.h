// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QOpenGLBuffer>
#include <QOpenGLFunctions_3_3_Core>
#include <QOpenGLVertexArrayObject>

#include <initializer_list>
#include <span>

namespace carom {

/// Vertices of floats that change now and then: lines, and polygons in world coordinates. Needs a current
/// context.
class GlStream {
  public:
    /// `sizes`: floats of each attribute of a vertex, in the order of their locations.
    void create(QOpenGLFunctions_3_3_Core& gl, std::initializer_list<int> sizes);

    /// A type of floats only, laid out as create() was told.
    template<typename Vertex>
    void upload(std::span<const Vertex> vertices) {
        static_assert(sizeof(Vertex) % sizeof(float) == 0);
        m_count = static_cast<int>(vertices.size());
        m_buffer.bind();
        m_buffer.allocate(vertices.data(), static_cast<int>(vertices.size_bytes()));
    }
    void draw(QOpenGLFunctions_3_3_Core& gl, GLenum mode);
    bool isEmpty() const { return m_count == 0; }

  private:
    QOpenGLVertexArrayObject m_array;
    QOpenGLBuffer m_buffer{QOpenGLBuffer::VertexBuffer};
    int m_count = 0; ///< vertices
};

} // namespace carom
