// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/widgets/resources.h"

#include "core/base/assert.h"

#include <QByteArray>
#include <QFile>
#include <QString>

// The macro declares a function of the global namespace, so it cannot stand inside ours. A static library's
// resources are registered by hand: nothing else would make the linker keep them.
static void registerResources() {
    static const bool once = [] {
        Q_INIT_RESOURCE(carom);
        Q_INIT_RESOURCE(carom_gallery);
        return true;
    }();
    static_cast<void>(once);
}

namespace carom {

QByteArray resource(const QString& name) {
    registerResources();
    QFile file(QStringLiteral(":/") + name);
    const bool opened = file.open(QIODevice::ReadOnly);
    ASSERT(opened);
    return opened ? file.readAll() : QByteArray();
}

} // namespace carom
