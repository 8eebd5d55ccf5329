// SPDX-License-Identifier: MIT
#include "top_view.hpp"

#include <algorithm>
#include <cmath>

#include "draw/canvas.hpp"

namespace dynamic_filter::app {

namespace {

constexpr float kPixel = 0.1F;  // [m]
constexpr int kMargin = 10, kLongSide = 2400;
constexpr io::Color kBackground{250, 250, 250};

/// The value below which `share` of the (sorted here) values lie.
template <class T>
T quantile(std::vector<T>& values, double share) {
    const auto at = values.begin() +
                    static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
    std::nth_element(values.begin(), at, values.end());
    return *at;
}

/// Every pixel as a block of `factor` x `factor`: small scenes fill a screen, and stay sharp.
io::Image enlarged(const io::Image& image, int factor) {
    io::Image out{factor * image.width, factor * image.height, {}};
    out.pixels.reserve(image.pixels.size() * static_cast<std::size_t>(factor * factor));
    for (int y = 0; y < out.height; ++y) {
        for (int x = 0; x < out.width; ++x) {
            out.pixels.push_back(
                image.pixels[static_cast<std::size_t>(y / factor * image.width + x / factor)]);
        }
    }
    return out;
}

}  // namespace

void TopView::add(const Points& points, const Labels& labels) {
    for (std::size_t i = 0; i < points.size(); ++i) {
        const auto cell = cell_of({points[i].x(), points[i].y(), 0.0F}, 1.0F / kPixel);
        if (!cell) continue;
        Column& column = columns_[pack(*cell)];
        if (labels[i] == Label::dynamic) {
            ++column.removed;
        } else {
            ++column.kept;
            column.highest_kept = std::max(column.highest_kept, points[i].z());
        }
    }
}

io::Image TopView::draw(bool removed) const {
    if (columns_.empty()) return {1, 1, {kBackground}};
    std::vector<int> xs, ys;
    std::vector<float> heights;
    for (const auto& [key, column] : columns_) {
        const Cell cell = unpack(key);
        xs.push_back(cell.x());
        ys.push_back(cell.y());
        if (column.kept > 0) heights.push_back(column.highest_kept);
    }
    const int x0 = quantile(xs, 0.002) - kMargin, x1 = quantile(xs, 0.998) + kMargin;
    const int y0 = quantile(ys, 0.002) - kMargin, y1 = quantile(ys, 0.998) + kMargin;
    const float low = heights.empty() ? 0.0F : quantile(heights, 0.02);
    const float high = heights.empty() ? 1.0F : std::max(low + 0.1F, quantile(heights, 0.98));
    const int shrink = std::max(1, (std::max(x1 - x0, y1 - y0) + kLongSide - 1) / kLongSide);

    io::Image image{(x1 - x0) / shrink + 1, (y1 - y0) / shrink + 1, {}};
    image.pixels.assign(
        static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height),
        kBackground);
    for (const auto& [key, column] : columns_) {
        const Cell cell = unpack(key);
        if (cell.x() < x0 || cell.x() > x1 || cell.y() < y0 || cell.y() > y1) continue;
        const int x = (cell.x() - x0) / shrink, y = image.height - 1 - (cell.y() - y0) / shrink;
        io::Color& pixel =
            image.pixels[static_cast<std::size_t>(y) * static_cast<std::size_t>(image.width) +
                         static_cast<std::size_t>(x)];
        if (removed && column.removed > 0) {
            pixel = kRemovedColor;
        } else if (column.kept > 0 && pixel != kRemovedColor) {
            pixel =
                height_color(std::clamp((column.highest_kept - low) / (high - low), 0.0F, 1.0F));
        }
    }
    return enlarged(image, std::max(1, kLongSide / std::max(image.width, image.height)));
}

}  // namespace dynamic_filter::app
