// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/widgets/body_box.h"

#include "ui/widgets/body_title.h"

#include <QAbstractListModel>
#include <QListView>
#include <QSignalBlocker>

#include <algorithm>
#include <utility>
#include <vector>

namespace carom {

namespace {
constexpr int shownCharacters = 14; // names are as long as one likes
}

class BodyBox::List : public QAbstractListModel {
  public:
    List(QString none, Offers offers, QObject* parent)
        : QAbstractListModel(parent), m_none(std::move(none)), m_offers(offers) {}

    void show(std::shared_ptr<const Pipeline> pipeline) {
        beginResetModel();
        m_pipeline = std::move(pipeline);
        m_bodies.clear();
        if (m_pipeline && m_offers == Offers::Bounded)
            m_bodies.assign(m_pipeline->bodies().bounded.begin(), m_pipeline->bodies().bounded.end());
        else if (m_pipeline)
            for (BodyIndex i = 0; i < m_pipeline->bodies().count(); ++i) m_bodies.push_back(i);
        endResetModel();
    }

    int rowCount(const QModelIndex& parent = {}) const override {
        return parent.isValid() ? 0 : static_cast<int>(m_bodies.size()) + 1;
    }
    QVariant data(const QModelIndex& index, int role) const override {
        const BodyIndex body = bodyAt(index.row());
        if (role == Qt::UserRole) return body;
        if (role != Qt::DisplayRole && role != Qt::EditRole) return {};
        return body == noBody ? m_none : bodyTitle(m_pipeline->scene(), body);
    }
    BodyIndex bodyAt(int row) const {
        return row > 0 && row <= std::ssize(m_bodies) ? m_bodies[static_cast<std::size_t>(row - 1)] : noBody;
    }
    int rowOf(BodyIndex body) const {
        if (body == noBody) return 0;
        const auto found = std::lower_bound(m_bodies.begin(), m_bodies.end(), body);
        return found != m_bodies.end() && *found == body ? static_cast<int>(found - m_bodies.begin()) + 1
                                                         : -1;
    }

  private:
    QString m_none;
    Offers m_offers;
    std::shared_ptr<const Pipeline> m_pipeline;
    std::vector<BodyIndex> m_bodies; ///< ascending
};

BodyBox::BodyBox(const QString& none, Offers offers, QWidget* parent)
    : QComboBox(parent), m_list(new List(none, offers, this)) {
    setSizeAdjustPolicy(QComboBox::AdjustToMinimumContentsLengthWithIcon);
    setMinimumContentsLength(shownCharacters);
    setModel(m_list);
    if (QListView* list = qobject_cast<QListView*>(view())) list->setUniformItemSizes(true);
    setCurrentIndex(0);
}

void BodyBox::showPipeline(const std::shared_ptr<const Pipeline>& pipeline) {
    const int row = currentIndex();
    const QString chosen = currentText();
    {
        const QSignalBlocker quiet(this); // in between nothing is chosen
        m_list->show(pipeline);
        // Mostly nothing was chosen, or it stands where it stood; only else every name has to be made.
        const bool stays = row <= 0 || itemText(row) == chosen;
        setCurrentIndex(std::max(0, stays ? row : findText(chosen)));
    }
    if (currentText() != chosen) Q_EMIT currentIndexChanged(currentIndex());
}

void BodyBox::choose(BodyIndex body) {
    const int row = m_list->rowOf(body);
    if (row >= 0) setCurrentIndex(row);
}

BodyIndex BodyBox::bodyAt(int row) const { return m_list->bodyAt(row); }

} // namespace carom

#include "moc_body_box.cpp"
