/* number-text.c -- writes floating-point numbers for human readers and for JSON. */
#include "base/number-text.h"

#include <float.h>
#include <math.h>
#include <string.h>

/* Shorten the exponent of a number: 1e-9 for 1e-09. */
static void
shorten_exponent(qdot_text *text, size_t from)
{
    char *e = strchr(text->at + from, 'e');

    if (e == NULL || (e[1] != '-' && e[1] != '+') || e[2] != '0')
        return;
    memmove(e + 2, e + 3, strlen(e + 3) + 1);
    qdot_text_truncate(text, text->n - 1);
}

void
qdot_number_text(qdot_text *text, double value, double error)
{
    int digits = 10;
    size_t before;

    value += 0.0;     /* turns -0 into 0 */
    if (error == 0) { /* write the shortest text that reads back as the same double */
        digits = qdot_double_digits(value, 1);
        if (fabs(value) >= 1 && fabs(value) < 1e15) /* write the number as an integer: 10, not 1e+01 */
            digits = (int)fmax(digits, floor(log10(fabs(value))) + 1);
    } else if (isfinite(error) && isfinite(value) && value != 0) {
        digits = (int)floor(log10(fabs(value))) - (int)floor(log10(error)) + 1;
        digits = digits < 1 ? 1 : digits > 16 ? 16 : digits;
    }
    before = text->n;
    qdot_text_double(text, value, digits);
    if (!text->failed)
        shorten_exponent(text, before);
}

bool
qdot_number_is_known(double value, double error)
{
    return !(isfinite(error) && error > 0.5 * fmax(1, fabs(value)));
}

void
qdot_number_text_known(qdot_text *text, double value, double error)
{
    if (qdot_number_is_known(value, error))
        qdot_number_text(text, value, error);
    else
        qdot_text_add(text, "unknown");
}

void
qdot_number_text_bound(qdot_text *text, double error)
{
    double power, lead;

    if (!isfinite(error) || error <= 0) {
        qdot_text_double(text, error, 1);
        return;
    }
    power = floor(log10(error));
    lead = ceil(error / pow(10, power) - 1e-9);
    if (lead > 9) {
        lead = 1;
        power++;
    }
    if (power >= 0 && power <= 3)
        qdot_text_format(text, "%.0f", lead * pow(10, power));
    else if (power >= -3 && power < 0)
        qdot_text_double(text, lead * pow(10, power), 1);
    else
        qdot_text_format(text, "%de%d", (int)lead, (int)power);
}

void
qdot_number_text_error(qdot_text *text, double error)
{
    if (isnan(error)) {
        qdot_text_add(text, " (error unknown)");
    } else if (error > 0) {
        qdot_text_add(text, " ± ");
        qdot_number_text_bound(text, error);
    }
}

void
qdot_number_text_with_error(qdot_text *text, double value, double error)
{
    qdot_number_text_known(text, value, error);
    qdot_number_text_error(text, error);
}

void
qdot_number_text_estimate(qdot_text *out, double value, double error)
{
    int decimals;

    if (!(error > 0) || !isfinite(error)) {
        qdot_text_double(out, value, 15);
        qdot_text_add(out, isnan(error) ? " ± unknown" : "");
        return;
    }
    decimals = 1 - (int)floor(log10(error));
    if (floor(error * pow(10, decimals) + 0.5) >= 100)
        decimals--;
    if (decimals >= 0 && decimals <= 15 && fabs(value) < 1e15) {
        qdot_text_format(out, "%.*f ± %.*f", decimals, value, decimals, error);
        return;
    }
    qdot_text_double(out, value, 15);
    qdot_text_add(out, " ± ");
    qdot_text_double(out, error, 2);
}

void
qdot_number_text_json(qdot_text *text, double value)
{
    if (isfinite(value))
        qdot_text_double(text, value, qdot_double_digits(value, fabs(value) < DBL_MIN ? 1 : DBL_DIG));
    else
        qdot_text_add(text, "null");
}
