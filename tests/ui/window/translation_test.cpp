// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/ide.h"

#include "ui/window/translation.h"

#include <QMenu>
#include <QMenuBar>
#include <QRegularExpression>

using namespace carom;
using namespace carom::test;

namespace {

/// What a text is filled in with: "%1 %2", and nothing else.
QStringList placesOf(const QString& text) {
    static const QRegularExpression place(QStringLiteral("%(\\d|n)"));
    QStringList places;
    for (QRegularExpressionMatchIterator found = place.globalMatch(text); found.hasNext();)
        places.append(found.next().captured());
    places.sort();
    return places;
}

QString plain(QString xml) {
    return xml.replace(QStringLiteral("&lt;"), QStringLiteral("<"))
        .replace(QStringLiteral("&amp;"), QStringLiteral("&"));
}

} // namespace

class TranslationTest : public QObject {
    Q_OBJECT
  private Q_SLOTS:
    void theMenusSpeakGermanOnceItIsChosen() {
        installTranslation(*qApp, QStringLiteral("de"));
        QObject owner;
        QMenuBar bar;
        Actions actions(&owner);
        actions.fill(bar);
        QCOMPARE(actions.menu(MenuId::File).title().remove(u'&'), QStringLiteral("Datei"));
        QCOMPARE(actions[ActionId::Undo].text().remove(u'&'), QString::fromUtf8("Rückgängig"));
        QVERIFY(actions[ActionId::Save].statusTip().contains(QStringLiteral("Datei")));
    }

    void noTranslationLosesAPlaceThatIsFilledIn() {
        const QString ts = QString::fromUtf8(
            readFile(QStringLiteral(CAROM_SOURCE_DIR "/resources/translations/carom_de.ts")));
        static const QRegularExpression pair(
            QStringLiteral("<source>([^<]*)</source>\\s*<translation>([^<]*)</translation>"));
        int compared = 0;
        for (QRegularExpressionMatchIterator found = pair.globalMatch(ts); found.hasNext(); ++compared) {
            const QRegularExpressionMatch match = found.next();
            QVERIFY2(placesOf(plain(match.captured(1))) == placesOf(plain(match.captured(2))),
                     qPrintable(match.captured(1)));
        }
        QVERIFY(compared > 300);
    }
};

CAROM_IDE_TEST_MAIN(TranslationTest)
#include "translation_test.moc"
