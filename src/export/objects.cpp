// SPDX-License-Identifier: MIT
/// `convert --to objects`: what moves, as objects with numbers that last.
#include <fmt/format.h>

#include <deque>
#include <map>

#include "base/output_folder.hpp"
#include "draw/canvas.hpp"
#include "dynamic_filter/file.hpp"
#include "dynamic_filter/writers.hpp"
#include "export/outputs.hpp"
#include "formats/label_files.hpp"
#include "objects/object_boxes.hpp"
#include "objects/object_log.hpp"

namespace fs = std::filesystem;

namespace dynamic_filter::app {

namespace {

constexpr std::uint32_t kMostNumbers = 65535;  // a label has 16 bits for them
constexpr std::size_t kMostDrawn = 500;        // points of a picture

class ObjectsSink final : public Sink {
public:
    explicit ObjectsSink(const ConvertOptions& o)
        : output_(o.output, object_files(), replaced_if(o.overwrite)),
          labels_(output_.subfolder("labels")),
          pictures_(output_.subfolder("pictures")) {}

    void append(const io::FullScan& scan, const Labels& labels, const std::string& stem) override {
        require_labels(labels, "--to objects");
        waiting_.push_back({labels, moving_points(scan.points, labels)});
        const auto& moving = waiting_.back().points;
        stems_.push_back(stem);
        poses_.push_back(scan.T_world_sensor);
        log_.add(stems_.size() - 1, scan.stamp,
                 places_at(scan.points, moving, scan.T_world_sensor));
    }

    std::string commit() override {
        log_.finish();
        io::sync_folder(labels_);
        const std::vector<ObjectSummary> objects = summaries_of(boxes_);
        const fs::path& folder = output_.path();
        io::write_file(folder / "objects.csv", objects_csv(objects));
        io::write_file(folder / "boxes.csv", boxes_csv(boxes_, stems_));
        io::write_file(folder / "objects.json", objects_json(objects, stems_));
        io::write_file(folder / "kitti_tracking.txt", kitti_tracking(boxes_, poses_));
        io::write_file(folder / "index.html", objects_page(objects));
        for (const auto& [number, drawn] : drawn_) {
            io::write_png(pictures_ / fmt::format("{:06}.png", number), picture_of(drawn.points));
        }
        output_.commit();
        std::string note = fmt::format("{} objects moved", objects.size());
        if (log_.size() > kMostNumbers) {
            note += fmt::format(
                "; labels hold {} numbers, so {} more objects have none there and no boxes",
                kMostNumbers, log_.size() - kMostNumbers);
        }
        return note;
    }

private:
    /// A scan whose objects are not yet known.
    struct Waiting {
        Labels labels;
        std::vector<std::uint32_t> points;  // those that move, by index
    };

    void write(const KnownScan& known) {
        const Waiting& next = waiting_.front();
        std::vector<std::uint32_t> values(next.labels.size());
        for (std::size_t i = 0; i < values.size(); ++i) {
            values[i] = static_cast<std::uint32_t>(next.labels[i]);
        }
        for (std::size_t i = 0; i < next.points.size(); ++i) {
            const std::uint32_t number = known.numbers[i];
            if (number <= kMostNumbers) values[next.points[i]] |= number << 16U;
        }
        io::write_numbered_labels(io::label_file(labels_, stems_[known.scan]), values,
                                  io::Durable::contents);
        for (const SeenObject& seen : known.objects) {
            if (seen.box.object <= kMostNumbers) note(seen);
        }
        waiting_.pop_front();
    }

    void note(const SeenObject& seen) {
        boxes_.push_back(seen.box);
        auto& [most, drawn] = drawn_[seen.box.object];
        if (most >= seen.places.size()) return;
        most = seen.places.size();
        drawn.clear();
        const std::size_t step = 1 + (seen.places.size() - 1) / kMostDrawn;
        for (std::size_t i = 0; i < seen.places.size(); i += step) {
            drawn.emplace_back((seen.places[i] - seen.box.center).cast<float>());
        }
    }

    static io::Image picture_of(const Points& points) {
        constexpr int kSide = 96;  // [pixels]
        const Eigen::AlignedBox3f box = box_of(points, 0.0F);
        Canvas canvas(kSide, kSide, from_aside(box, 1.0F, 2.2F, 0.35F));
        canvas.draw(points, 1.5F, [&](std::size_t i) { return height_color(points[i], box); });
        return canvas.picture({250, 250, 250});
    }

    OutputFolder output_;
    fs::path labels_, pictures_;
    std::deque<Waiting> waiting_;
    ObjectLog log_{[this](const KnownScan& known) { write(known); }};
    std::vector<ObjectBox> boxes_;
    struct Drawn {
        std::size_t most = 0;  // points of the scan
        Points points{};
    };
    std::map<std::uint32_t, Drawn> drawn_;  // of the scan with most points, by number
    std::vector<std::string> stems_;        // by scan
    std::vector<Pose> poses_;               // by scan
};

}  // namespace

const FolderFiles& object_files() {
    static const FolderFiles files{
        .files = {"objects.csv", "boxes.csv", "objects.json", "kitti_tracking.txt", "index.html"},
        .folders = {{"labels", ".label"}, {"pictures", ".png"}}};
    return files;
}

std::unique_ptr<Sink> make_objects_sink(const ConvertOptions& o) {
    return std::make_unique<ObjectsSink>(o);
}

}  // namespace dynamic_filter::app
