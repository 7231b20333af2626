#pragma once
/// The bound on the position error against its threshold: now as a bar, its last minutes as a line.

#include <QWidget>

#include "ros/rviz/operator_view.h"

namespace slipnav {

/// Colors are those of the window's palette, so that it is readable in light and dark styles.
class BoundChart : public QWidget {
 public:
  explicit BoundChart(QWidget* parent);
  void display(const OperatorPicture& picture);

 protected:
  void paintEvent(QPaintEvent* event) override;

 private:
  void paintBar(QPainter& painter, const QRectF& place) const;
  void paintHistory(QPainter& painter, const QRectF& place) const;

  OperatorPicture picture_;
};

}  // namespace slipnav
