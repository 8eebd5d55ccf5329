// SPDX-License-Identifier: MIT
/// `convert --to objects`: what moves, as objects with numbers that last.
#include <fmt/format.h>

#include <deque>
#include <map>

#include "base/output_folder.hpp"
#include "draw/canvas.hpp"
#include "dynamic_filter/file.hpp"
#include "dynamic_filter/writers.hpp"
#include "export/objects/object_boxes.hpp"
#include "export/objects/object_tracker.hpp"
#include "export/outputs.hpp"
#include "formats/label_files.hpp"

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
        Waiting waiting{stems_.size(), labels, {}, {}, {}};
        for (std::uint32_t i = 0; i < labels.size(); ++i) {
            if (labels[i] != Label::dynamic || !is_measured(scan.points[i])) continue;
            waiting.points.push_back(i);
            waiting.places.emplace_back(scan.T_world_sensor * scan.points[i].cast<double>());
        }
        waiting.objects = tracker_.follow(waiting.places, waiting.scan, scan.stamp);
        waiting_.push_back(std::move(waiting));
        stems_.push_back(stem);
        poses_.push_back(scan.T_world_sensor);
        while (!waiting_.empty() && is_settled(waiting_.front())) write_next();
    }

    std::string commit() override {
        while (!waiting_.empty()) write_next();
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
        if (unnumbered_ > 0) {
            note += fmt::format(
                "; labels hold {} numbers, so {} more objects have none there and no boxes",
                kMostNumbers, unnumbered_);
        }
        return note;
    }

private:
    /// A scan whose objects may still turn out to be stray echoes.
    struct Waiting {
        std::size_t scan;
        Labels labels;
        std::vector<std::uint32_t> points;    // those that move, by index
        std::vector<Eigen::Vector3d> places;  // parallel, in the world
        std::vector<std::uint32_t> objects;   // parallel, by the tracker's numbers
    };

    [[nodiscard]] bool is_settled(const Waiting& waiting) const {
        return std::all_of(waiting.objects.begin(), waiting.objects.end(), [&](auto object) {
            return object == kNoObject || tracker_.objects()[object].is_sure() ||
                   !tracker_.may_go_on(object);
        });
    }

    /// The number in the files; 0: none.
    std::uint32_t number_of(std::uint32_t object) {
        if (object == kNoObject || !tracker_.objects()[object].is_sure()) return 0;
        const auto next = static_cast<std::uint32_t>(numbers_.size() + 1);
        const auto [number, is_new] = numbers_.try_emplace(object, next);
        if (number->second <= kMostNumbers) return number->second;
        unnumbered_ += is_new ? 1U : 0U;
        return 0;
    }

    void write_next() {
        const Waiting& next = waiting_.front();
        std::vector<std::uint32_t> values(next.labels.size());
        for (std::size_t i = 0; i < values.size(); ++i) {
            values[i] = static_cast<std::uint32_t>(next.labels[i]);
        }
        std::map<std::uint32_t, std::vector<Eigen::Vector3d>> places;  // by the tracker's numbers
        for (std::size_t i = 0; i < next.points.size(); ++i) {
            const std::uint32_t number = number_of(next.objects[i]);
            if (number == 0) continue;
            values[next.points[i]] |= number << 16U;
            places[next.objects[i]].push_back(next.places[i]);
        }
        io::write_numbered_labels(io::label_file(labels_, stems_[next.scan]), values,
                                  io::Durable::contents);
        for (const auto& [object, of_object] : places) add_box(object, next.scan, of_object);
        waiting_.pop_front();
    }

    void add_box(std::uint32_t object, std::size_t scan,
                 const std::vector<Eigen::Vector3d>& places) {
        const auto& sightings = tracker_.objects()[object].sightings;
        const auto sighting = std::partition_point(
            sightings.begin(), sightings.end(), [&](const Sighting& s) { return s.scan < scan; });
        ObjectBox box = box_around(places, sighting->heading);
        box.object = number_of(object);
        box.scan = scan;
        box.stamp = sighting->stamp;
        box.velocity = sighting->velocity;
        boxes_.push_back(box);
        auto& [most, drawn] = drawn_[box.object];
        if (most >= places.size()) return;
        most = places.size();
        drawn.clear();
        const std::size_t step = 1 + (places.size() - 1) / kMostDrawn;
        for (std::size_t i = 0; i < places.size(); i += step) {
            drawn.emplace_back((places[i] - box.center).cast<float>());
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
    ObjectTracker tracker_;
    std::deque<Waiting> waiting_;
    std::map<std::uint32_t, std::uint32_t> numbers_;  // of the files, by the tracker's
    std::size_t unnumbered_ = 0;
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
