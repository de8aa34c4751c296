// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/widgets/panel_parts.h"

#include <QComboBox>
#include <QHBoxLayout>
#include <QToolButton>

#include <algorithm>

namespace carom {

QToolButton* wordButton(const char* name, const QString& words, const QString& tip) {
    QToolButton* button = new QToolButton;
    button->setObjectName(QLatin1StringView(name));
    button->setText(words);
    button->setProperty("role", QStringLiteral("words"));
    button->setToolTip(tip);
    return button;
}

namespace {

/// As wide as told, or as its buttons need in the language chosen.
class Controls : public QWidget {
  public:
    explicit Controls(int width) : m_width(width) {
        setSizePolicy(QSizePolicy::Fixed, QSizePolicy::Preferred);
    }
    QSize sizeHint() const override { return minimumSizeHint(); }
    QSize minimumSizeHint() const override {
        const QSize least = layout()->minimumSize();
        return {std::max(m_width, least.width()), least.height()};
    }

  private:
    int m_width; ///< [px]
};

} // namespace

QWidget* besideControls(QLayout* controls, int width, QWidget* content) {
    constexpr int leastLetters = 12; // of an entry, which may be longer than the panel is wide
    QWidget* left = new Controls(width);
    left->setLayout(controls);
    for (QComboBox* box : left->findChildren<QComboBox*>()) {
        box->setSizeAdjustPolicy(QComboBox::AdjustToMinimumContentsLengthWithIcon);
        box->setMinimumContentsLength(leastLetters);
    }
    controls->setContentsMargins(0, 0, 0, 0);
    QWidget* whole = new QWidget;
    QHBoxLayout* row = new QHBoxLayout(whole);
    row->setContentsMargins(6, 4, 6, 6);
    row->addWidget(left);
    row->addWidget(content, 1);
    return whole;
}

} // namespace carom
