// SPDX-License-Identifier: MIT
#include "peers/cdr_text.hpp"

#include <fastcdr/Cdr.h>
#include <fastcdr/FastBuffer.h>

#include <iomanip>
#include <sstream>
#include <stdexcept>

namespace dynamic_filter::peers {

namespace {

using eprosima::fastcdr::Cdr;
#if __has_include(<fastcdr/CdrEncoding.hpp>)  // from version 2 on
constexpr auto kCdr = eprosima::fastcdr::CdrVersion::DDS_CDR;
std::size_t position(const Cdr& cdr) { return cdr.get_serialized_data_length(); }
#else
constexpr auto kCdr = Cdr::DDS_CDR;
std::size_t position(const Cdr& cdr) { return cdr.getSerializedDataLength(); }
#endif

/// Reads in the order of the definitions of ROS 2.
class Reader {
public:
    explicit Reader(Bytes& message)
        : size_(message.size()),
          buffer_(reinterpret_cast<char*>(message.data()), message.size()),
          cdr_(buffer_, Cdr::DEFAULT_ENDIAN, kCdr) {
        cdr_.read_encapsulation();
    }

    template <class T>
    T number() {
        T value{};
        cdr_ >> value;
        out_ << std::setprecision(17) << +value << ' ';
        return value;
    }
    template <class T>
    void numbers(int count) {
        for (int i = 0; i < count; ++i) number<T>();
    }
    void text() {
        std::string value;
        cdr_ >> value;
        out_ << '"' << value << "\" ";
    }
    template <class Element>
    void sequence(const Element& element) {
        for (auto left = number<std::uint32_t>(); left > 0; --left) element();
    }
    std::string finish() {
        out_ << "left " << size_ - position(cdr_);
        return out_.str();
    }

private:
    std::size_t size_;
    eprosima::fastcdr::FastBuffer buffer_;
    Cdr cdr_;
    std::ostringstream out_;
};

void header(Reader& in) {
    in.number<std::int32_t>();
    in.number<std::uint32_t>();
    in.text();
}

void pose(Reader& in) { in.numbers<double>(7); }

void cloud(Reader& in) {
    header(in);
    in.numbers<std::uint32_t>(2);  // height, width
    in.sequence([&] {
        in.text();
        in.number<std::uint32_t>();
        in.number<std::uint8_t>();
        in.number<std::uint32_t>();
    });
    in.number<bool>();
    in.numbers<std::uint32_t>(2);  // point_step, row_step
    in.sequence([&] { in.number<std::uint8_t>(); });
    in.number<bool>();
}

void transforms(Reader& in) {
    in.sequence([&] {
        header(in);
        in.text();
        pose(in);
    });
}

void odometry(Reader& in) {
    header(in);
    in.text();
    pose(in);
    in.numbers<double>(36 + 6 + 36);
}

void path(Reader& in) {
    header(in);
    in.sequence([&] {
        header(in);
        pose(in);
    });
}

void occupancy(Reader& in) {
    header(in);
    in.number<std::int32_t>();
    in.number<std::uint32_t>();
    in.number<float>();
    in.numbers<std::uint32_t>(2);
    pose(in);
    in.sequence([&] { in.number<std::int8_t>(); });
}

/// As of Humble.
void markers(Reader& in) {
    in.sequence([&] {
        header(in);
        in.text();
        in.numbers<std::int32_t>(3);
        pose(in);
        in.numbers<double>(3);
        in.numbers<float>(4);
        in.number<std::int32_t>();
        in.number<std::uint32_t>();
        in.number<bool>();
        in.sequence([&] { in.numbers<double>(3); });
        in.sequence([&] { in.numbers<float>(4); });
        in.text();
        header(in);  // texture
        in.text();
        in.sequence([&] { in.number<std::uint8_t>(); });
        in.sequence([&] { in.numbers<float>(2); });
        in.text();
        in.text();
        in.text();  // mesh_file
        in.sequence([&] { in.number<std::uint8_t>(); });
        in.number<bool>();
    });
}

void diagnostics(Reader& in) {
    header(in);
    in.sequence([&] {
        in.number<std::uint8_t>();
        for (int i = 0; i < 3; ++i) in.text();
        in.sequence([&] {
            in.text();
            in.text();
        });
    });
}

/// As rmw_cyclonedds sends it: the client and its request stand before the answer.
void trigger_response(Reader& in) {
    in.number<std::uint64_t>();
    in.number<std::int64_t>();
    in.number<bool>();
    in.text();
}

}  // namespace

std::string text_of(const std::string& type, Bytes message) {
    Reader in(message);
    if (type == "sensor_msgs::msg::dds_::PointCloud2_") {
        cloud(in);
    } else if (type == "tf2_msgs::msg::dds_::TFMessage_") {
        transforms(in);
    } else if (type == "nav_msgs::msg::dds_::Odometry_") {
        odometry(in);
    } else if (type == "nav_msgs::msg::dds_::Path_") {
        path(in);
    } else if (type == "nav_msgs::msg::dds_::OccupancyGrid_") {
        occupancy(in);
    } else if (type == "visualization_msgs::msg::dds_::MarkerArray_") {
        markers(in);
    } else if (type == "diagnostic_msgs::msg::dds_::DiagnosticArray_") {
        diagnostics(in);
    } else if (type == "std_srvs::srv::dds_::Trigger_Response_") {
        trigger_response(in);
    } else {
        throw std::runtime_error("unknown type " + type);
    }
    return in.finish();
}

}  // namespace dynamic_filter::peers
