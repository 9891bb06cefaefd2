// The border to GDAL: drivers registered, its messages caught instead of printed, its handles owned.
#pragma once

#include <gdal.h>

#include <memory>
#include <string>

namespace data {

/// While it lives, what GDAL, OGR and PROJ complain about on this thread is kept here and not printed.
/// A JPEG that ends early counts as an error, which GDAL takes for a warning and fills with grey.
/// Registers GDAL's drivers on first use.
class GdalMessages {
  public:
    GdalMessages();
    ~GdalMessages();
    GdalMessages(const GdalMessages&) = delete;
    GdalMessages& operator=(const GdalMessages&) = delete;

    /// An error was reported; warnings do not count.
    bool has_failed() const { return has_failed_; }
    /// The first error (else the last warning) on one line, or `otherwise` when there was nothing.
    std::string text(const std::string& otherwise) const;

  private:
    static void receive(CPLErr severity, CPLErrorNum number, const char* message);
    std::string message_;
    bool has_failed_ = false;
};

struct DatasetCloser {
    void operator()(void* dataset) const { GDALClose(dataset); }
};
using DatasetPtr = std::unique_ptr<void, DatasetCloser>;

}  // namespace data
