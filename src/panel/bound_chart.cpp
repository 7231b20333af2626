#include "panel/bound_chart.h"

#include <QPainter>

#include <algorithm>

namespace slipnav {
namespace {

constexpr int kHeight_px = 96;
constexpr double kBarHeight_px = 22.0;
constexpr double kMargin_px = 4.0;
constexpr double kHistory_s = 300.0;
constexpr double kHeadroom = 1.25;  // of the line's scale above the threshold
const QColor kFine(46, 139, 87);
const QColor kNear(218, 140, 16);
const QColor kBeyond(200, 40, 40);

const QColor& colorOf(double share) { return share < 0.7 ? kFine : share < 1.0 ? kNear : kBeyond; }

}  // namespace

BoundChart::BoundChart(QWidget* parent) : QWidget(parent) {
  setMinimumHeight(kHeight_px);
  setAccessibleName("bound of the position error");
}

void BoundChart::display(const OperatorPicture& picture) {
  picture_ = picture;
  update();
}

void BoundChart::paintEvent(QPaintEvent*) {
  QPainter painter(this);
  painter.setRenderHint(QPainter::Antialiasing);
  const QRectF all = QRectF(rect()).adjusted(kMargin_px, kMargin_px, -kMargin_px, -kMargin_px);
  paintBar(painter, QRectF(all.left(), all.top(), all.width(), kBarHeight_px));
  paintHistory(painter, all.adjusted(0.0, kBarHeight_px + kMargin_px, 0.0, 0.0));
}

void BoundChart::paintBar(QPainter& painter, const QRectF& place) const {
  painter.setPen(palette().color(QPalette::Mid));
  painter.setBrush(palette().color(QPalette::Base));
  painter.drawRect(place);
  if (picture_.bound_m && picture_.threshold_m > 0.0) {
    const double share = *picture_.bound_m / picture_.threshold_m;
    QRectF filled = place;
    filled.setWidth(place.width() * std::clamp(share, 0.0, 1.0));
    painter.fillRect(filled, colorOf(share));
  }
  const QString words =
      picture_.bound_m ? QString("%1 of %2 m").arg(*picture_.bound_m, 0, 'f', 2).arg(picture_.threshold_m, 0, 'f', 1)
                       : QString("no forecast");
  painter.setPen(palette().color(QPalette::Text));
  painter.drawText(place, Qt::AlignCenter, words);
}

void BoundChart::paintHistory(QPainter& painter, const QRectF& place) const {
  painter.setPen(palette().color(QPalette::Mid));
  painter.setBrush(palette().color(QPalette::Base));
  painter.drawRect(place);
  const double top_m = kHeadroom * picture_.threshold_m;
  if (top_m <= 0.0) {
    return;
  }
  const auto at = [&](double age_s, double bound_m) {
    return QPointF(place.right() - place.width() * std::min(1.0, age_s / kHistory_s),
                   place.bottom() - place.height() * std::clamp(bound_m / top_m, 0.0, 1.0));
  };
  painter.setPen(QPen(kBeyond, 1.0, Qt::DashLine));
  painter.drawLine(at(kHistory_s, picture_.threshold_m), at(0.0, picture_.threshold_m));
  QPolygonF line;
  for (const auto& [age_s, bound_m] : picture_.history) {
    line.append(at(age_s, bound_m));
  }
  painter.setPen(QPen(palette().color(QPalette::Text), 1.5));
  painter.drawPolyline(line);
  painter.setPen(palette().color(QPalette::Text));
  painter.drawText(place.adjusted(kMargin_px, 0.0, 0.0, 0.0), Qt::AlignLeft | Qt::AlignBottom, "last 5 minutes");
}

}  // namespace slipnav
