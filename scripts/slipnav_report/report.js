/* The plots of the page: those over time share their axis and a cursor, whose place is marked on the track. */
"use strict";
(function ($) {
  const data = JSON.parse(document.getElementById("data").textContent);
  const dark = window.matchMedia("(prefers-color-scheme: dark)");
  const DASHES = {"-": [], "--": [6, 4], "-.": [7, 3, 2, 3], ":": [2, 3]};
  const GRID = "rgba(128,128,128,0.25)", STANDSTILL = "rgba(128,128,128,0.16)";
  const LEAST_DRAG = 5;  // pixels
  const LABEL_WIDTH = 48;  // pixels; one width, so that the time axes lie below each other
  const NEAR_S = 1.5;  // farther from the cursor there is no value
  let shown = null;  // [from, to] of all time axes; null for the whole drive
  let cursor = null;

  const column = (curve, key) => data.columns[curve[key]];
  const pairs = (x, y) => x.map((value, i) => [value, y[i]]);
  const colour = (value) => dark.matches && data.dark[value] || value;
  const opacity = (value) => dark.matches ? 0.6 * value : value;

  function nearest(x, at, isUsed) {
    let best = -1;
    for (let i = 0; i < x.length; ++i) {
      if (x[i] !== null && isUsed(i) && (best < 0 || Math.abs(x[i] - at) < Math.abs(x[best] - at))) best = i;
    }
    return best;
  }

  function bandSeries(curve, index) {
    const x = column(curve, "x"), color = colour(curve.color), id = "low" + index;
    return [{id, color, data: pairs(x, column(curve, "low")), lines: {show: true, lineWidth: 0}},
            {color, data: pairs(x, column(curve, "high")), fillBetween: id,
             lines: {show: true, lineWidth: 0, fill: opacity(curve.alpha)}}];
  }

  function curveSeries(curve) {
    const color = colour(curve.color), values = pairs(column(curve, "x"), column(curve, "y"));
    if (!curve.marker) {
      return {color, data: values, dash: DASHES[curve.dash], lines: {show: true, lineWidth: curve.width}};
    }
    const points = {show: true, radius: Math.max(1, curve.size / 2), lineWidth: 0, fill: 1, fillColor: color,
                    symbol: curve.marker === "^" ? "triangle" : "circle"};
    return {color, data: values, lines: {show: false}, points};
  }

  function seriesOf(panel) {
    return panel.curves.filter((curve) => !curve.hidden)
      .flatMap((curve, i) => "low" in curve ? bandSeries(curve, i) : [curveSeries(curve)]);
  }

  /* Of what can be seen between two times, with a margin; the whole panel's own where nothing can. */
  function heightOf(panel) {
    if (!shown || panel.log) return panel.ylim;
    let low = Infinity, high = -Infinity;
    for (const curve of panel.curves.filter((one) => !one.hidden)) {
      const x = column(curve, "x");
      for (const values of ["y", "low", "high"].filter((key) => key in curve).map((key) => column(curve, key))) {
        for (let i = 0; i < x.length; ++i) {
          if (x[i] === null || values[i] === null || x[i] < shown[0] || x[i] > shown[1]) continue;
          low = Math.min(low, values[i]);
          high = Math.max(high, values[i]);
        }
      }
    }
    if (low > high) return panel.ylim;
    const margin = 0.05 * (high - low) || 0.05 * Math.abs(high) || 1;
    return [low - margin, high + margin];
  }

  function markings(panel) {
    const stops = panel.track ? [] : data.stops.map(([from, to]) => ({xaxis: {from, to}, color: STANDSTILL}));
    const shade = data.shade + (dark.matches ? "30" : "4d");
    const ranges = panel.ranges.map(([from, to]) => ({yaxis: {from, to}, color: shade}));
    const levels = panel.levels.map(({y, color}) => ({yaxis: {from: y, to: y}, color: colour(color), lineWidth: 1}));
    return [...stops, ...ranges, ...levels];
  }

  function axisOf([min, max], isLog) {
    const tickFormatter = (value) => String(Number(value.toFixed(9)));  // its own calls 0.75 0.8
    const axis = {min, max, show: true, reserveSpace: true, autoScale: "none", tickColor: GRID, showMinorTicks: false,
                  tickFormatter};
    if (!isLog) return axis;
    const ticks = [1e-4, 1e-2, 1, 1e2].map((value) => [value, value === 1 ? "1" : value.toExponential(0)]);
    return {...axis, ticks, transform: (v) => Math.log(Math.max(v, 1e-9)), inverseTransform: Math.exp};
  }

  function draw(panel) {
    const window_ = panel.track ? panel.window || [panel.xlim, panel.ylim] : [shown || [0, data.end], heightOf(panel)];
    const options = {
      series: {shadowSize: 0},
      xaxis: axisOf(window_[0], false), yaxis: {...axisOf(window_[1], panel.log), labelWidth: LABEL_WIDTH},
      grid: {color: GRID, borderWidth: 1, borderColor: GRID, markings: markings(panel), hoverable: false},
      legend: {show: false},
      zoom: {interactive: false}, pan: {interactive: false, enableTouch: false}, recenter: {interactive: false},
      hooks: {drawSeries: [(plot, context, series) => context.setLineDash(series.dash || [])]},
    };
    panel.plot = $.plot(panel.place, seriesOf(panel), options);
    if (panel.track) makeEqual(panel);
    panel.place.append(panel.marks, panel.why, panel.box);
    showCursor(panel);
  }

  /* Widens the axis that has more pixels to a meter. */
  function makeEqual(panel) {
    const axes = panel.plot.getAxes(), [x, y] = [axes.xaxis, axes.yaxis];
    const scale = Math.max((x.max - x.min) / panel.plot.width(), (y.max - y.min) / panel.plot.height());
    for (const [axis, pixels] of [[x, panel.plot.width()], [y, panel.plot.height()]]) {
      const middle = 0.5 * (axis.min + axis.max);
      axis.options.min = middle - 0.5 * scale * pixels;
      axis.options.max = middle + 0.5 * scale * pixels;
    }
    panel.plot.setupGrid();
    panel.plot.draw();
  }

  const drawTimes = () => panels.filter((panel) => !panel.track).forEach(draw);

  function place(mark, panel, x, y) {
    const offset = panel.plot.getPlotOffset(), axes = panel.plot.getAxes();
    const left = axes.xaxis.p2c(x), top = y === null ? 0 : axes.yaxis.p2c(y);
    const isInside = left >= 0 && left <= panel.plot.width() && top >= 0 && top <= panel.plot.height();
    mark.css({display: isInside ? "block" : "none", left: offset.left + left, top: offset.top + top});
    if (y === null) mark.css("height", panel.plot.height());
  }

  function valueText(curve) {
    const key = "y" in curve ? "y" : "high";
    const time = column(curve, "t" in curve ? "t" : "x"), values = column(curve, key);
    const at = nearest(time, cursor, (i) => values[i] !== null);
    if (at < 0 || Math.abs(time[at] - cursor) > NEAR_S) return "–";
    const text = (value) => String(Number(value.toPrecision(4)));
    if ("t" in curve) return text(column(curve, "x")[at]) + ", " + text(values[at]);
    return key === "y" ? text(values[at]) : text(column(curve, "low")[at]) + " … " + text(values[at]);
  }

  function showCursor(panel) {
    if (cursor === null) return;
    if (panel.track) {
      const curve = panel.curves.find((one) => "t" in one);
      if (!curve) return;
      const at = nearest(column(curve, "t"), cursor, () => true);
      place(panel.marks, panel, column(curve, "x")[at], column(curve, "y")[at]);
    } else {
      place(panel.marks, panel, cursor, null);
    }
    panel.values.forEach(([curve, cell]) => cell.text(panel.track && !("t" in curve) ? "" : valueText(curve)));
  }

  function moveCursor(time) {
    cursor = Math.min(Math.max(time, 0), data.end);
    $("#cursor").text("t = " + cursor.toFixed(2) + " s");
    panels.forEach(showCursor);
  }

  /* Pixels from the corner of the axes, never outside of them. */
  function pixelsOf(panel, event) {
    const origin = panel.place.offset(), inside = panel.plot.getPlotOffset();
    const clamped = (value, most) => Math.min(Math.max(value, 0), most);
    return {left: clamped(event.pageX - origin.left - inside.left, panel.plot.width()),
            top: clamped(event.pageY - origin.top - inside.top, panel.plot.height())};
  }

  /* The time at a place of the page: of the nearest estimate, on the track. */
  function timeAt(panel, event) {
    const axes = panel.plot.getAxes(), {left, top} = pixelsOf(panel, event);
    if (!panel.track) return axes.xaxis.c2p(left);
    const curve = panel.curves.find((one) => "t" in one);
    if (!curve) return null;
    const [x, y] = [column(curve, "x"), column(curve, "y")];
    const away = x.map((value, i) => Math.hypot(axes.xaxis.p2c(value) - left, axes.yaxis.p2c(y[i]) - top));
    return column(curve, "t")[nearest(away, 0, () => true)];
  }

  function zoom(panel, box) {
    const axes = panel.plot.getAxes();
    const x = [axes.xaxis.c2p(box.left), axes.xaxis.c2p(box.left + box.width)];
    if (panel.track) {
      panel.window = [x, [axes.yaxis.c2p(box.top + box.height), axes.yaxis.c2p(box.top)]];
      draw(panel);
    } else {
      shown = x;
      drawTimes();
    }
  }

  /* Between two places of a panel, from top to bottom where the axis is one of time. */
  function boxOf(panel, from, to) {
    const box = {left: Math.min(from.left, to.left), width: Math.abs(from.left - to.left)};
    return panel.track ? {...box, top: Math.min(from.top, to.top), height: Math.abs(from.top - to.top)}
      : {...box, top: 0, height: panel.plot.height()};
  }

  function watchDrags(panel) {
    const element = panel.place[0];
    let from = null;
    element.addEventListener("pointerdown", (event) => {
      if (event.button !== 0 || event.pointerType === "touch") return;
      from = pixelsOf(panel, event);
      element.setPointerCapture(event.pointerId);
    });
    element.addEventListener("pointermove", (event) => {
      if (!from) return;
      const box = boxOf(panel, from, pixelsOf(panel, event)), inside = panel.plot.getPlotOffset();
      panel.box.css({...box, left: inside.left + box.left, top: inside.top + box.top, display: "block"});
    });
    element.addEventListener("pointerup", (event) => {
      if (!from) return;
      const box = boxOf(panel, from, pixelsOf(panel, event));
      from = null;
      panel.box.css("display", "none");
      if (Math.min(box.width, box.height) >= LEAST_DRAG) zoom(panel, box);
    });
    element.addEventListener("pointercancel", () => {
      from = null;
      panel.box.css("display", "none");
    });
  }

  function reset(panel) {
    if (panel.track) {
      panel.window = null;
      draw(panel);
    } else {
      shown = null;
      drawTimes();
    }
  }

  function swatch(one) {
    const color = colour(one.color);
    if ("alpha" in one) return `<rect width="26" height="11" fill="${color}" fill-opacity="${opacity(one.alpha)}"/>`;
    if (one.marker) return `<circle cx="13" cy="6" r="${Math.max(2, one.size / 2)}" fill="${color}"/>`;
    const dash = (DASHES[one.dash] || []).join(" ");
    return `<path d="M0 6H26" stroke="${color}" stroke-width="${one.width || 1}" stroke-dasharray="${dash}"/>`;
  }

  function fillLegend(panel) {
    panel.values = [];
    panel.legend.empty();
    const isAlone = panel.curves.length === 1;
    for (const one of [...panel.curves, ...panel.levels]) {
      const name = one.name || (isAlone ? panel.label : "");
      if (!name) continue;
      const sample = $("<td>").html(`<svg viewBox="0 0 26 11">${swatch(one)}</svg>`);
      const cell = $("<td>");
      const row = $("<tr>").toggleClass("hidden", !!one.hidden).append(sample, $("<td>").text(name), cell);
      panel.legend.append(row);
      if (!panel.curves.includes(one)) continue;
      panel.values.push([one, cell]);
      row.on("click", () => {
        one.hidden = !one.hidden;
        row.toggleClass("hidden", one.hidden);
        draw(panel);
      });
    }
  }

  function build(panel) {
    const title = [panel.label, panel.title].filter((text) => text).join(" · ");
    panel.place = $("<div class=plot>");
    panel.legend = $("<table class=legend>");
    panel.marks = $("<div>").addClass(panel.track ? "mark dot" : "mark line");
    panel.box = $("<div class='mark box'>");
    panel.why = $("<div class=why>").text(panel.empty);
    const block = $("<div class=panel>").append($("<h3>").text(panel.track ? "north over east [m]" : title));
    $("#" + panel.figure + " .panels").append(block.append(panel.place, panel.legend));
    fillLegend(panel);
    draw(panel);
    watchDrags(panel);
    panel.place.on("dblclick", () => reset(panel));
    panel.place.on("mousemove", (event) => {
      const time = timeAt(panel, event);
      if (time !== null && Number.isFinite(time)) moveCursor(time);
    });
  }

  /* Where a browser cannot do this, its reader has the pictures. */
  function showPictures() {
    document.querySelectorAll("figure").forEach((figure) => {
      figure.querySelector(".panels").innerHTML = figure.querySelector("noscript").textContent;
    });
  }

  const panels = data.panels;
  function redraw() {
    panels.forEach((panel) => {
      fillLegend(panel);
      draw(panel);
    });
  }
  try {
    panels.forEach(build);
    document.getElementById("hint").hidden = false;
    dark.addEventListener("change", redraw);
    let waiting = 0;
    window.addEventListener("resize", () => {
      clearTimeout(waiting);
      waiting = setTimeout(redraw, 200);
    });
  } catch (error) {
    showPictures();
    throw error;
  }
})(jQuery);
