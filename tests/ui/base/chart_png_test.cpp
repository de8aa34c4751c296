// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/test_class.h"

#include "ui/base/chart_png.h"

#include <QBuffer>
#include <QImage>
#include <QRandomGenerator>
#include <QTest>

// What we write is read by Qt, which leaves that to libpng.

namespace carom {
namespace {

constexpr quint32 chartSeed = 4711;

QImage pictureOfChance(QRandomGenerator& random, QSize size) {
    QImage picture(size, QImage::Format_RGB32);
    for (int y = 0; y < size.height(); ++y)
        for (int x = 0; x < size.width(); ++x)
            picture.setPixel(x, y, random.bounded(2) == 0 ? 0xFFFFFFFF : random.generate() | 0xFF000000);
    return picture;
}

} // namespace

class ChartPngTest : public QObject {
    Q_OBJECT

  private Q_SLOTS:
    void everyPixelIsReadAsItWasWritten() {
        qInfo("seed %u", chartSeed);
        QRandomGenerator random(chartSeed);
        for (const QSize size : {QSize(1, 1), QSize(3, 2), QSize(640, 1), QSize(1, 97), QSize(301, 203)}) {
            QImage picture = pictureOfChance(random, size);
            picture.setDotsPerMeterX(3780);
            picture.setDotsPerMeterY(3779);
            const QImage read = QImage::fromData(chartPng(picture), "PNG");
            QCOMPARE(read.size(), size);
            QCOMPARE(read.convertToFormat(QImage::Format_RGB32), picture);
            QCOMPARE(read.dotsPerMeterX(), 3780);
            QCOMPARE(read.dotsPerMeterY(), 3779);
        }
    }

    // A curve on white: the file is no larger than Qt's.
    void aChartIsAsSmallAsQtMakesIt() {
        QImage picture(960, 600, QImage::Format_RGB32);
        picture.fill(Qt::white);
        for (int x = 0; x < picture.width(); ++x)
            for (int k = 0; k < 3; ++k)
                picture.setPixel(x, 300 + k + static_cast<int>(200 * std::sin(0.01 * x)),
                                 0xFF2060A0 + 40U * k);
        QByteArray bytes;
        QBuffer qt(&bytes);
        qt.open(QIODevice::WriteOnly);
        QVERIFY(picture.save(&qt, "PNG"));
        const QByteArray ours = chartPng(picture);
        QVERIFY2(ours.size() <= bytes.size(),
                 qPrintable(QStringLiteral("%1, Qt %2 bytes").arg(ours.size()).arg(bytes.size())));
    }

    void withoutPixelsThereIsNoFile() { QVERIFY(chartPng(QImage()).isEmpty()); }
};

} // namespace carom

CAROM_TEST(chart_png_test, carom::ChartPngTest)
#include "chart_png_test.moc"
