/* pdf.h -- a page printed by a browser without a window.
 *
 * Tests  tests/script/files/report.sh
 */
#ifndef QDOT_SHOW_PDF_H
#define QDOT_SHOW_PDF_H

#include <stddef.h>

#include "base/status.h"

/* Print the page [length bytes of HTML] to a PDF file by the first of chromium, chromium-browser,
 * google-chrome and chrome that is installed. The page and the browser's profile are kept in a
 * folder of their own in TMPDIR while it works, which takes seconds. Errors: QDOT_EIO: none is
 * installed, or it fails, or wrote nothing within a minute; QDOT_EINTR. */
QDOT_MUST_CHECK qdot_status qdot_pdf_print(const char *page, size_t length,
                                           const char *path);

#endif
