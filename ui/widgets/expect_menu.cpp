// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/widgets/expect_menu.h"

#include "core/expectations/expectation_report.h"
#include "ui/widgets/text_of.h"

#include <QCoreApplication>
#include <QMenu>

namespace carom {

void fillExpectMenu(QMenu& menu, const Scene& scene, const std::vector<Expectation>& proposals,
                    const std::function<void(const Expectation&)>& take) {
    menu.clear();
    const auto translated = [](const char* text) {
        return QCoreApplication::translate("carom::ExpectMenu", text);
    };
    menu.addAction(proposals.empty()
                       ? translated(QT_TRANSLATE_NOOP("carom::ExpectMenu", "Nothing has been measured yet"))
                       : translated(QT_TRANSLATE_NOOP("carom::ExpectMenu", "Write into the text:")))
        ->setEnabled(false);
    for (const Expectation& proposal : proposals)
        menu.addAction(textOf(wishOf(scene, proposal)), &menu, [take, proposal] { take(proposal); });
}

} // namespace carom
