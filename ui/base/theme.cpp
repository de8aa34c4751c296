// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/base/theme.h"

#include <QApplication>
#include <QFile>
#include <QIconEngine>
#include <QJsonDocument>
#include <QJsonObject>
#include <QPainter>
#include <QPixmap>
#include <QRegularExpression>
#include <QStyleFactory>
#include <QSvgRenderer>

#include <map>
#include <tuple>
#include <utility>

namespace carom {
namespace {

QJsonObject palettes() {
    QFile file(QStringLiteral(":/themes/palette.json"));
    if (!file.open(QIODevice::ReadOnly)) return {};
    return QJsonDocument::fromJson(file.readAll()).object();
}

/// Draws an SVG in the size that is wanted, when it is wanted: sharp on every screen, and eighty icons of
/// which most are never seen cost nothing at the start.
class Glyph : public QIconEngine {
  public:
    Glyph(QByteArray svg, const QColor& colour, const QColor& disabled)
        : m_svg(std::move(svg)), m_colour(colour), m_disabled(disabled) {}

    QIconEngine* clone() const override { return new Glyph(*this); }
    void paint(QPainter* painter, const QRect& place, QIcon::Mode mode, QIcon::State) override {
        QByteArray coloured = m_svg;
        const QColor& colour = mode == QIcon::Disabled ? m_disabled : m_colour;
        coloured.replace("currentColor", colour.name().toLatin1());
        QSvgRenderer(coloured).render(painter, place);
    }
    QPixmap pixmap(const QSize& size, QIcon::Mode mode, QIcon::State state) override {
        QPixmap& known = m_pixmaps[{mode == QIcon::Disabled, size.width(), size.height()}];
        if (!known.isNull()) return known;
        known = QPixmap(size);
        known.fill(Qt::transparent);
        QPainter painter(&known);
        paint(&painter, {{0, 0}, size}, mode, state);
        return known;
    }

  private:
    QByteArray m_svg;
    QColor m_colour, m_disabled;
    std::map<std::tuple<bool, int, int>, QPixmap> m_pixmaps;
};

// Sizes in pixels are those of a screen at 96 dots an inch; Qt scales them on denser ones.
constexpr const char* sheet = R"(
QToolTip { background: @panel; color: @text; border: 1px solid @border; padding: 4px; }
QMainWindow::separator { background: @border; width: 1px; height: 1px; }
QMenuBar { background: @window; padding: 2px 4px; }
QMenuBar::item { padding: 4px 8px; border-radius: 4px; background: transparent; }
QMenuBar::item:selected { background: @hover; }
QMenu { background: @panel; border: 1px solid @border; padding: 4px; }
QMenu::item { padding: 5px 28px 5px 8px; border-radius: 4px; }
QMenu::item:selected { background: @selection; }
QMenu::item:disabled { color: @disabledText; }
QMenu::separator { height: 1px; background: @border; margin: 4px 6px; }
QMenu::icon { padding-left: 6px; }
QMenu::icon:checked { background: @selection; border: 1px solid @accent; border-radius: 3px; }
QToolBar { background: @window; border: none; border-bottom: 1px solid @border; padding: 4px 6px; spacing: 2px; }
QToolBar::separator { background: @border; width: 1px; margin: 4px 6px; }
QToolButton { border: 1px solid transparent; border-radius: 5px; padding: 4px; }
QToolButton[popupMode="2"] { padding-right: 16px; }
QToolButton[popupMode="2"]::menu-indicator { subcontrol-origin: padding; subcontrol-position: center right; right: 3px; }
QToolButton[role="words"] { background: @button; border-color: @border; padding: 2px 10px; }
QToolButton[role="words"][popupMode="2"] { padding-right: 22px; }
QToolButton:hover, QToolButton[role="words"]:hover { background: @hover; }
QToolButton:pressed, QToolButton:checked, QToolButton[role="words"]:pressed,
QToolButton[role="words"]:checked { background: @selection; }
QToolButton:disabled { color: @disabledText; }
QStatusBar { background: @window; border-top: 1px solid @border; color: @mutedText; }
QStatusBar::item { border: none; }
QStatusBar QToolButton { padding: 0 6px; }
QDockWidget { titlebar-close-icon: none; titlebar-normal-icon: none; }
QDockWidget::title { background: @window; padding: 6px 8px; border-bottom: 1px solid @border; text-align: left; }
QTabBar { qproperty-drawBase: 0; background: @window; }
QTabBar::tab { background: transparent; color: @mutedText; padding: 6px 12px; border: none;
               border-top: 2px solid transparent; }
QTabBar::tab:selected { color: @text; border-top: 2px solid @accent; background: @panel; }
QTabBar::tab:hover:!selected { color: @text; background: @hover; }
QTabWidget::pane { border: 1px solid @border; background: @window; }
QAbstractScrollArea { border: none; }
QTreeView, QTableView, QListView, QPlainTextEdit, QTextBrowser { background: @panel; }
QTreeView::item, QListView::item { padding: 3px 4px; background: transparent; border: none; }
QTreeView::item:alternate, QListView::item:alternate { background: @alternate; }
QTreeView::item:selected, QTableView::item:selected, QListView::item:selected { background: @selection; color: @text; }
QHeaderView { background: @panel; }
QHeaderView::section { background: @panel; color: @mutedText; border: none; padding: 0 4px; }
QHeaderView::section:horizontal { border-bottom: 1px solid @border; padding: 5px 4px; }
QTableCornerButton::section { background: @panel; border: none; border-bottom: 1px solid @border; }
QAbstractScrollArea::corner { background: transparent; border: none; }
QSplitter::handle { background: @border; }
QLineEdit, QComboBox, QSpinBox, QDoubleSpinBox { background: @button; border: 1px solid @border;
            border-radius: 4px; padding: 3px 6px; min-height: 18px; selection-background-color: @accent;
            selection-color: @accentText; }
QLineEdit:focus, QComboBox:focus, QAbstractSpinBox:focus { border-color: @accent; }
QComboBox::drop-down { border: none; width: 22px; }
QComboBox::down-arrow { image: url(:/icons/arrow_down.svg); width: 14px; height: 14px; }
QAbstractSpinBox::up-button, QAbstractSpinBox::down-button { border: none; background: transparent; width: 20px; }
QAbstractSpinBox::up-arrow { image: url(:/icons/arrow_up.svg); width: 10px; height: 10px; }
QAbstractSpinBox::down-arrow { image: url(:/icons/arrow_down.svg); width: 10px; height: 10px; }
QComboBox QAbstractItemView { background: @panel; border: 1px solid @border; selection-background-color: @selection;
            selection-color: @text; }
QPushButton { background: @button; border: 1px solid @border; border-radius: 4px; padding: 4px 12px; }
QPushButton:hover { background: @hover; }
QPushButton:default, QPushButton:focus, QToolButton[role="words"]:focus { border-color: @accent; }
QPushButton:disabled { color: @disabledText; }
QPushButton:flat { background: transparent; border-color: transparent; }
QPushButton:flat:hover { background: @hover; }
QCheckBox, QRadioButton { spacing: 6px; }
QCheckBox::indicator, QTreeView::indicator, QListView::indicator { width: 14px; height: 14px;
            border: 1px solid @mutedText; border-radius: 3px; background: @panel; }
QCheckBox::indicator:checked, QTreeView::indicator:checked, QListView::indicator:checked { background: @accent; border-color: @accent; image: url(:/icons/@tick.svg); }
QCheckBox::indicator:disabled { border-color: @disabledText; }
QCheckBox:focus, QRadioButton:focus { color: @accent; }
QDialogButtonBox { dialogbuttonbox-buttons-have-icons: 0; }
QScrollBar { background: transparent; border: none; }
QScrollBar:vertical { width: 11px; }
QScrollBar:horizontal { height: 11px; }
QScrollBar::handle { background: @border; border-radius: 3px; margin: 2px; min-height: 24px; min-width: 24px; }
QScrollBar::handle:hover { background: @disabledText; }
QScrollBar::add-line, QScrollBar::sub-line { width: 0; height: 0; }
QScrollBar::add-page, QScrollBar::sub-page { background: transparent; }
QFrame[role="popup"] { background: @panel; border: 1px solid @accent; border-radius: 5px; }
QLabel[role="badge"] { background: @error; color: @accentText; padding: 5px 10px; border-radius: 4px; }
*[role="muted"] { color: @mutedText; }
QLabel[role="verdict"] { background: @panel; border: 1px solid @border; border-radius: 5px; padding: 6px 10px; font-size: 12pt; }
*[role="error"] { color: @error; }
)";

} // namespace

Theme loadTheme(bool dark) {
    const QJsonObject roles = palettes();
    const QString variant = dark ? QStringLiteral("dark") : QStringLiteral("light");
    Theme theme;
    theme.dark = dark;
#define CAROM_ROLE(role)                                                                                     \
    theme.role = QColor(roles.value(QStringLiteral(#role)).toObject().value(variant).toString());
#include "ui/base/theme_roles.def"
#undef CAROM_ROLE
    return theme;
}

QPalette Theme::palette() const {
    QPalette p;
    p.setColor(QPalette::Window, window);
    p.setColor(QPalette::WindowText, text);
    p.setColor(QPalette::Base, panel);
    p.setColor(QPalette::AlternateBase, alternate);
    p.setColor(QPalette::Text, text);
    p.setColor(QPalette::PlaceholderText, mutedText);
    p.setColor(QPalette::Button, button);
    p.setColor(QPalette::ButtonText, text);
    p.setColor(QPalette::BrightText, error);
    p.setColor(QPalette::Highlight, accent);
    p.setColor(QPalette::HighlightedText, accentText);
    p.setColor(QPalette::Link, accent);
    p.setColor(QPalette::ToolTipBase, panel);
    p.setColor(QPalette::ToolTipText, text);
    p.setColor(QPalette::Mid, border);
    p.setColor(QPalette::Dark, border);
    for (const QPalette::ColorRole role : {QPalette::WindowText, QPalette::Text, QPalette::ButtonText})
        p.setColor(QPalette::Disabled, role, disabledText);
    return p;
}

QString Theme::styleSheet() const {
    QString filled = QString::fromLatin1(sheet);
    filled.replace(QStringLiteral("@tick"),
                   dark ? QStringLiteral("tick_on_light") : QStringLiteral("tick_on_dark"));
#define CAROM_ROLE(role) filled.replace(QRegularExpression(QStringLiteral("@" #role "\\b")), role.name());
#include "ui/base/theme_roles.def"
#undef CAROM_ROLE
    return filled;
}

QIcon Theme::icon(const QString& name) const { return icon(name, text); }

QIcon Theme::icon(const QString& name, const QColor& colour) const {
    QFile file(QStringLiteral(":/icons/%1.svg").arg(name));
    if (!file.open(QIODevice::ReadOnly)) return {};
    return QIcon(new Glyph(file.readAll(), colour, disabledText));
}

void applyTheme(QApplication& application, const Theme& theme) {
    const QString sheet = theme.styleSheet();
    if (application.styleSheet() == sheet) return; // setting it would lay out every widget once more
    application.setStyle(QStyleFactory::create(QStringLiteral("Fusion")));
    application.setPalette(theme.palette());
    application.setStyleSheet(sheet);
}

} // namespace carom
