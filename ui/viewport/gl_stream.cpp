// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/viewport/gl_stream.h"

#include <numeric>

namespace carom {

void GlStream::create(QOpenGLFunctions_3_3_Core& gl, std::initializer_list<int> sizes) {
    m_array.create();
    const QOpenGLVertexArrayObject::Binder bound(&m_array);
    m_buffer.create();
    m_buffer.setUsagePattern(QOpenGLBuffer::StreamDraw);
    m_buffer.bind();
    const std::size_t stride =
        sizeof(float) * static_cast<std::size_t>(std::accumulate(sizes.begin(), sizes.end(), 0));
    GLuint location = 0;
    std::size_t offset = 0;
    for (const int size : sizes) {
        gl.glEnableVertexAttribArray(location);
        gl.glVertexAttribPointer(location++, size, GL_FLOAT, GL_FALSE, static_cast<GLsizei>(stride),
                                 reinterpret_cast<const void*>(offset));
        offset += sizeof(float) * static_cast<std::size_t>(size);
    }
}

void GlStream::draw(QOpenGLFunctions_3_3_Core& gl, GLenum mode) {
    if (m_count == 0) return;
    const QOpenGLVertexArrayObject::Binder bound(&m_array);
    gl.glDrawArrays(mode, 0, m_count);
}

} // namespace carom
