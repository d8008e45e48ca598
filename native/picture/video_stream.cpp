#include "picture/video_stream.h"

extern "C" {
#include <libavcodec/avcodec.h>
#include <libavformat/avformat.h>
#include <libavutil/display.h>
#include <libavutil/imgutils.h>
#include <libavutil/log.h>
#include <libavutil/pixdesc.h>
#include <libswscale/swscale.h>
}

#include <algorithm>
#include <cmath>
#include <limits>
#include <opencv2/imgproc.hpp>
#include <string_view>

#include "core/error.h"
#include "core/parallel.h"
#include "picture/colour.h"
#include "picture/openimageio.h"

namespace stillwater {
namespace {

constexpr double deep_white = 255 << 8;  // what swscale makes of white in 16 bits
constexpr int spare = 64;  // pixels beside a row: swscale writes whole vectors

std::string reason(int code) {
  char text[AV_ERROR_MAX_STRING_SIZE] = {};
  av_strerror(code, text, sizeof text);
  return text;
}

// FFmpeg gives single pictures formats of their own: png_pipe, image2, ...
bool is_picture(const AVInputFormat& format) {
  const std::string_view name = format.name;
  return name.find("_pipe") != std::string_view::npos || name.find("image2") != std::string_view::npos;
}

const std::int32_t* display_matrix(const AVStream& stream) {
#if LIBAVFORMAT_VERSION_MAJOR >= 61
  const AVPacketSideData* data = av_packet_side_data_get(
      stream.codecpar->coded_side_data, stream.codecpar->nb_coded_side_data, AV_PKT_DATA_DISPLAYMATRIX);
  return data ? reinterpret_cast<const std::int32_t*>(data->data) : nullptr;
#else
  return reinterpret_cast<const std::int32_t*>(
      av_stream_get_side_data(&stream, AV_PKT_DATA_DISPLAYMATRIX, nullptr));
#endif
}

// Quarter turns clockwise that bring a stored frame upright, 0 .. 3.
int quarter_turns(const AVStream& stream) {
  const std::int32_t* matrix = display_matrix(stream);
  if (!matrix) return 0;
  const double degrees = -av_display_rotation_get(matrix);
  return std::isfinite(degrees) ? (static_cast<int>(std::lround(degrees / 90)) % 4 + 4) % 4 : 0;
}

bool has_full_range(const AVFrame& frame) {
  switch (frame.format) {
    case AV_PIX_FMT_YUVJ420P:
    case AV_PIX_FMT_YUVJ422P:
    case AV_PIX_FMT_YUVJ444P:
    case AV_PIX_FMT_YUVJ440P: return true;
    default: return frame.color_range == AVCOL_RANGE_JPEG;
  }
}

int matrix_of(const AVFrame& frame) {
  switch (frame.colorspace) {
    case AVCOL_SPC_BT709: return SWS_CS_ITU709;
    case AVCOL_SPC_BT470BG:
    case AVCOL_SPC_SMPTE170M: return SWS_CS_ITU601;
    case AVCOL_SPC_SMPTE240M: return SWS_CS_SMPTE240M;
    case AVCOL_SPC_FCC: return SWS_CS_FCC;
    case AVCOL_SPC_BT2020_NCL:
    case AVCOL_SPC_BT2020_CL: return SWS_CS_BT2020;
    default: return frame.height >= 720 ? SWS_CS_ITU709 : SWS_CS_ITU601;
  }
}

bool is_transparent(const cv::Mat_<cv::Vec4f>& picture) {
  return std::any_of(picture.begin(), picture.end(), [](const cv::Vec4f& pixel) { return pixel[3] < 1; });
}

// Straight display-referred colours, laid over black in linear light.
cv::Mat_<cv::Vec3f> over_black(const cv::Mat_<cv::Vec4f>& straight) {
  cv::Mat_<cv::Vec4f> pixels(straight.size());
  parallel_rows(pixels.rows, 32, [&](int first, int last) {
    for (int y = first; y < last; ++y) {
      for (int x = 0; x < pixels.cols; ++x) {
        const cv::Vec4f& in = straight(y, x);
        pixels(y, x) = {in[0] * in[3], in[1] * in[3], in[2] * in[3], in[3]};
      }
      float* row = pixels[y][0].val;
      display_to_scene(row, row, static_cast<size_t>(pixels.cols));
      linear_to_srgb(row, row, 4 * static_cast<size_t>(pixels.cols));
    }
  });
  cv::Mat_<cv::Vec3f> colours;
  cv::cvtColor(pixels, colours, cv::COLOR_BGRA2BGR);
  return colours;
}

}  // namespace

struct VideoStream::State {
  std::string path;
  AVFormatContext* file = nullptr;
  AVCodecContext* decoder = nullptr;
  AVPacket* packet = av_packet_alloc();
  AVFrame* decoded = av_frame_alloc();
  SwsContext* converter = nullptr;
  AVStream* stream = nullptr;
  int turns = 0;
  bool drained = false;
  bool seen_transparent = false;

  State() = default;
  State(const State&) = delete;
  State& operator=(const State&) = delete;

  ~State() {
    sws_freeContext(converter);
    av_frame_free(&decoded);
    av_packet_free(&packet);
    avcodec_free_context(&decoder);
    avformat_close_input(&file);
  }

  void open_file();
  void open_decoder(const AVCodec& codec);
  bool next_packet();
};

void VideoStream::State::open_file() {
  require_readable_file(path);
  av_log_set_level(AV_LOG_QUIET);
  const int opened = avformat_open_input(&file, path.c_str(), nullptr, nullptr);
  if (opened < 0) fail(path, "is not a picture or clip that can be read", reason(opened));
  const int probed = avformat_find_stream_info(file, nullptr);
  if (is_picture(*file->iformat)) {
    const bool has_size = file->nb_streams > 0 && file->streams[0]->codecpar->width > 0;
    throw FileError(path + (has_size ? ": is a picture, not a clip" : ": is not a picture or clip that can be read"));
  }
  if (probed < 0) fail(path, "is not a picture or clip that can be read", reason(probed));
  const AVCodec* codec = nullptr;
  const int found = av_find_best_stream(file, AVMEDIA_TYPE_VIDEO, -1, -1, &codec, 0);
  if (found == AVERROR_DECODER_NOT_FOUND) fail(path, "is in a coding that FFmpeg can't read here", "");
  if (found < 0) throw FileError(path + ": holds no video");
  stream = file->streams[found];
  turns = quarter_turns(*stream);
  open_decoder(*codec);
}

void VideoStream::State::open_decoder(const AVCodec& codec) {
  decoder = avcodec_alloc_context3(&codec);
  int done = avcodec_parameters_to_context(decoder, stream->codecpar);
  decoder->thread_count = threads();
  if (done >= 0) done = avcodec_open2(decoder, &codec, nullptr);
  if (done < 0) fail(path, "is in a coding that FFmpeg can't read here", reason(done));
}

// The next packet of the video that is to be shown; false at the end of the file.
bool VideoStream::State::next_packet() {
  for (;;) {
    av_packet_unref(packet);
    const int got = av_read_frame(file, packet);
    if (got == AVERROR_EOF) return false;
    if (got < 0) fail(path, "cannot be read to its end", reason(got));
    if (packet->stream_index == stream->index) return true;
  }
}

VideoStream::VideoStream(const std::string& path) : state_(std::make_unique<State>()) {
  state_->path = path;
  state_->open_file();
}

VideoStream::~VideoStream() = default;
VideoStream::VideoStream(VideoStream&&) noexcept = default;
VideoStream& VideoStream::operator=(VideoStream&&) noexcept = default;

int VideoStream::width() const {
  return state_->turns % 2 ? state_->stream->codecpar->height : state_->stream->codecpar->width;
}

int VideoStream::height() const {
  return state_->turns % 2 ? state_->stream->codecpar->width : state_->stream->codecpar->height;
}

double VideoStream::fps() const {
  const AVRational rate = av_guess_frame_rate(state_->file, state_->stream, nullptr);
  return rate.num > 0 && rate.den > 0 ? av_q2d(rate) : 0;
}

std::vector<double> VideoStream::times_to_end() {
  std::vector<double> times, unknown;
  while (state_->next_packet()) {
    const AVPacket& packet = *state_->packet;
    if (packet.flags & AV_PKT_FLAG_DISCARD) continue;
    if (packet.pts == AV_NOPTS_VALUE) unknown.push_back(std::numeric_limits<double>::quiet_NaN());
    else times.push_back(static_cast<double>(packet.pts) * av_q2d(state_->stream->time_base));
  }
  std::sort(times.begin(), times.end());
  times.insert(times.end(), unknown.begin(), unknown.end());
  return times;
}

bool VideoStream::advance() {
  State& state = *state_;
  for (;;) {
    const int got = avcodec_receive_frame(state.decoder, state.decoded);
    if (got >= 0) return true;
    if (got == AVERROR_EOF) return false;
    if (got != AVERROR(EAGAIN)) fail(state.path, "cannot be decoded", reason(got));
    if (state.drained) return false;
    state.drained = !state.next_packet();
    const int sent = avcodec_send_packet(state.decoder, state.drained ? nullptr : state.packet);
    if (sent < 0 && sent != AVERROR_INVALIDDATA) fail(state.path, "cannot be decoded", reason(sent));
  }
}

bool VideoStream::seen_transparent() const { return state_->seen_transparent; }

cv::Mat_<cv::Vec3f> VideoStream::frame() {
  State& state = *state_;
  const AVFrame& decoded = *state.decoded;
  const int wide = decoded.width, high = decoded.height;
  const auto format = static_cast<AVPixelFormat>(decoded.format);
  const AVPixFmtDescriptor* stored = av_pix_fmt_desc_get(format);
  const bool deep = stored && stored->comp[0].depth > 8;
  const bool has_alpha = stored && stored->flags & AV_PIX_FMT_FLAG_ALPHA;
  const AVPixelFormat plain = deep ? AV_PIX_FMT_RGB48 : AV_PIX_FMT_RGB24;
  const AVPixelFormat with_alpha = deep ? AV_PIX_FMT_RGBA64 : AV_PIX_FMT_RGBA;
  state.converter = sws_getCachedContext(
      state.converter, wide, high, format, wide, high, has_alpha ? with_alpha : plain,
      SWS_BICUBIC | SWS_FULL_CHR_H_INT | SWS_FULL_CHR_H_INP | SWS_ACCURATE_RND | SWS_BITEXACT, nullptr, nullptr, nullptr);
  if (!state.converter) throw FileError(state.path + ": its kind of pixels can't be converted");
  constexpr int one = 1 << 16;
  sws_setColorspaceDetails(state.converter, sws_getCoefficients(matrix_of(decoded)), has_full_range(decoded),
                           sws_getCoefficients(SWS_CS_DEFAULT), 1, 0, one, one);
  cv::Mat whole(high + 1, wide + spare, CV_MAKETYPE(deep ? CV_16U : CV_8U, has_alpha ? 4 : 3));
  unsigned char* rows[4] = {whole.data};
  const int strides[4] = {static_cast<int>(whole.step)};
  if (sws_scale(state.converter, decoded.data, decoded.linesize, 0, high, rows, strides) != high)
    throw FileError(state.path + ": its kind of pixels can't be converted");
  cv::Mat picture;
  whole(cv::Rect(0, 0, wide, high)).convertTo(picture, CV_32F, 1.0 / (deep ? deep_white : 255));
  if (deep) cv::min(picture, cv::Scalar::all(1), picture);
  if (has_alpha) {
    state.seen_transparent = state.seen_transparent || is_transparent(picture);
    picture = over_black(picture);
  }
  constexpr cv::RotateFlags turn[] = {cv::ROTATE_90_CLOCKWISE, cv::ROTATE_180, cv::ROTATE_90_COUNTERCLOCKWISE};
  if (state.turns > 0) cv::rotate(picture, picture, turn[state.turns - 1]);
  return picture;
}

}  // namespace stillwater
