// SPDX-License-Identifier: MIT
#include "draw/animation.hpp"

#include <webp/encode.h>
#include <webp/mux.h>

#include "dynamic_filter/error.hpp"
#include "dynamic_filter/file.hpp"

namespace dynamic_filter::app {

struct Animation::Encoder {
    std::unique_ptr<WebPAnimEncoder, decltype(&WebPAnimEncoderDelete)> of_webp{
        nullptr, WebPAnimEncoderDelete};

    void require(int ok) const {
        if (ok == 0) {
            throw Error(std::string("cannot encode the animation: ") +
                        WebPAnimEncoderGetError(of_webp.get()));
        }
    }
};

Animation::Animation(int milliseconds_each)
    : encoder_(std::make_unique<Encoder>()), step_(milliseconds_each) {}

Animation::~Animation() = default;

void Animation::add(const io::Image& image) {
    constexpr float kQuality = 60.0F;
    if (!encoder_->of_webp) {
        WebPAnimEncoderOptions options;
        WebPAnimEncoderOptionsInit(&options);
        options.allow_mixed = 1;
        encoder_->of_webp.reset(WebPAnimEncoderNew(image.width, image.height, &options));
    }
    WebPPicture picture;
    WebPPictureInit(&picture);
    picture.use_argb = 1;
    picture.width = image.width;
    picture.height = image.height;
    WebPConfig config;
    WebPConfigPreset(&config, WEBP_PRESET_DRAWING, kQuality);
    const std::unique_ptr<WebPPicture, decltype(&WebPPictureFree)> owner(&picture, WebPPictureFree);
    const auto* bytes = reinterpret_cast<const std::uint8_t*>(image.pixels.data());
    if (WebPPictureImportRGB(&picture, bytes, 3 * image.width) == 0) throw std::bad_alloc();
    encoder_->require(WebPAnimEncoderAdd(encoder_->of_webp.get(), &picture, now_, &config));
    now_ += step_;
}

void Animation::write(const std::filesystem::path& file) {
    constexpr int kLast = 2000;
    WebPAnimEncoder* const encoder = encoder_->of_webp.get();
    encoder_->require(WebPAnimEncoderAdd(encoder, nullptr, now_ - step_ + kLast, nullptr));
    WebPData data;
    WebPDataInit(&data);
    const std::unique_ptr<WebPData, decltype(&WebPDataClear)> owner(&data, WebPDataClear);
    encoder_->require(WebPAnimEncoderAssemble(encoder, &data));
    io::write_file(file, {reinterpret_cast<const char*>(data.bytes), data.size});
}

}  // namespace dynamic_filter::app
