// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/simulation/pipeline.h"

#include <QComboBox>

#include <memory>

namespace carom {

/// Lets one choose a body by its name, or none. Names are made when they are shown: a scene may have 200,000.
class BodyBox : public QComboBox {
    Q_OBJECT
  public:
    enum class Offers { All, Bounded };

    /// `none`: what the first row says, which stands for no body.
    BodyBox(const QString& none, Offers offers, QWidget* parent = nullptr);

    /// What was chosen stays so where a body of that name is there; null: no bodies.
    void showPipeline(const std::shared_ptr<const Pipeline>& pipeline);
    /// noBody: the first row; a body that is not offered changes nothing.
    void choose(BodyIndex body);
    /// The body of a row; noBody for the first.
    BodyIndex bodyAt(int row) const;

  private:
    class List;
    List* m_list;
};

} // namespace carom
