// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/test_class.h"

#include "ui/viewport/gif_writer.h"

#include "core/math/random.h"

#include <QBuffer>
#include <QGuiApplication>
#include <QImageReader>
#include <QSet>
#include <QTest>

using namespace carom;

namespace {

constexpr std::uint64_t seed = 89;

/// Every pixel one of so many colours, at random: nothing for the dictionary to find, so it fills and is
/// begun anew again and again.
QImage noise(Random& random, const QSize& size, int colours) {
    QList<QRgb> palette;
    for (int i = 0; i < colours; ++i) {
        const auto channel = [&random] {
            return static_cast<int>(static_cast<double>(random.below(32)) * 255 / 31 + 0.5);
        };
        palette.append(qRgb(channel(), channel(), channel()));
    }
    QImage image(size, QImage::Format_RGB32);
    for (int y = 0; y < size.height(); ++y)
        for (int x = 0; x < size.width(); ++x)
            image.setPixel(
                x, y, palette[static_cast<qsizetype>(random.below(static_cast<std::uint64_t>(colours)))]);
    return image;
}

QByteArray written(const QList<QImage>& pictures, double rate = 25) {
    QByteArray bytes;
    QBuffer buffer(&bytes);
    buffer.open(QIODevice::WriteOnly);
    GifWriter writer(buffer, pictures.first().size(), rate);
    for (const QImage& picture : pictures) writer.add(picture);
    return writer.finish() ? bytes : QByteArray();
}

} // namespace

class GifWriterTest : public QObject {
    Q_OBJECT

  private Q_SLOTS:
    void picturesOfFewColoursComeBackAsTheyWere() {
        qInfo("seed %llu", static_cast<unsigned long long>(seed));
        Random random(seed);
        QList<QImage> pictures;
        for (const int colours : {1, 2, 200, 17}) pictures.append(noise(random, {97, 61}, colours));
        QByteArray bytes = written(pictures);
        QBuffer buffer(&bytes);
        buffer.open(QIODevice::ReadOnly);
        QImageReader reader(&buffer, "gif");
        for (const QImage& picture : pictures) {
            const QImage read = reader.read();
            QVERIFY2(!read.isNull(), qPrintable(reader.errorString()));
            QCOMPARE(read.convertToFormat(QImage::Format_RGB32), picture);
            QCOMPARE(reader.nextImageDelay(), 40);
        }
        QCOMPARE(reader.loopCount(), -1); // for ever
    }

    void anAnimationTakesAsLongAsItsPicturesSay() {
        // 30 pictures a second are 3.33 hundredths each: rounded one by one they would run 11 % fast.
        for (const double rate : {30.0, 24.0, 7.0, 50.0}) {
            const QImage picture(4, 4, QImage::Format_RGB32);
            const int pictures = static_cast<int>(rate) * 10;
            QByteArray bytes = written(QList<QImage>(pictures, picture), rate);
            QBuffer buffer(&bytes);
            buffer.open(QIODevice::ReadOnly);
            QImageReader reader(&buffer, "gif");
            int milliseconds = 0;
            while (reader.canRead() && !reader.read().isNull()) milliseconds += reader.nextImageDelay();
            QCOMPARE(milliseconds, 10'000);
        }
    }

    void aPhotographKeepsItsLook() {
        QImage sky(128, 128, QImage::Format_RGB32);
        for (int y = 0; y < 128; ++y)
            for (int x = 0; x < 128; ++x) sky.setPixel(x, y, qRgb(2 * x, 2 * y, 255 - x - y));
        QByteArray bytes = written({sky});
        const QImage read = QImage::fromData(bytes, "GIF").convertToFormat(QImage::Format_RGB32);
        QCOMPARE(read.size(), sky.size());
        // Dithering moves single pixels; the mean over eight by eight of them stays.
        constexpr int block = 8;
        constexpr double sameTo = 6; // of 255
        for (int by = 0; by < 128; by += block)
            for (int bx = 0; bx < 128; bx += block) {
                double red = 0;
                for (int y = by; y < by + block; ++y)
                    for (int x = bx; x < bx + block; ++x)
                        red += (qRed(read.pixel(x, y)) - qRed(sky.pixel(x, y))) / double(block * block);
                QVERIFY2(std::abs(red) < sameTo, qPrintable(QString::number(red)));
            }
    }

    void bestColoursAreThoseOfThePictureWhereTheyAreFew() {
        Random random(seed);
        const QImage image = noise(random, {64, 64}, 40);
        QSet<QRgb> there;
        for (int y = 0; y < 64; ++y)
            for (int x = 0; x < 64; ++x) there.insert(image.pixel(x, y));
        const QList<QRgb> best = bestColours(image, 256);
        QCOMPARE(QSet<QRgb>(best.begin(), best.end()), there);
        QCOMPARE(bestColours(image, 8).size(), 8);
    }
};

CAROM_TEST_WITH(QCoreApplication, gif_writer_test, GifWriterTest)
#include "gif_writer_test.moc"
