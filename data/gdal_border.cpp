#include "data/gdal_border.h"

#include <cpl_error.h>

#include <algorithm>
#include <string_view>

namespace data {

GdalMessages::GdalMessages() {
    if (GDALGetDriverCount() == 0) GDALAllRegister();
    CPLErrorReset();
    CPLPushErrorHandlerEx(&GdalMessages::receive, this);
}

GdalMessages::~GdalMessages() {
    CPLPopErrorHandler();
}

void GdalMessages::receive(CPLErr severity, CPLErrorNum, const char* message) {
    if (severity != CE_Warning && severity != CE_Failure) return;
    auto* self = static_cast<GdalMessages*>(CPLGetErrorHandlerUserData());
    if (self->has_failed_) return;
    const bool is_cut_jpeg =
        std::string_view(message).find("Premature end of JPEG") != std::string_view::npos;
    self->has_failed_ = severity == CE_Failure || is_cut_jpeg;
    self->message_ = message;
    std::replace(self->message_.begin(), self->message_.end(), '\n', ' ');
}

std::string GdalMessages::text(const std::string& otherwise) const {
    return message_.empty() ? otherwise : message_;
}

}  // namespace data
