/* letters.c -- the letters allowed in names, and the spelling of Greek ones and of the sign of infinity. */
#include "lang/source/letters.h"

#include <string.h>

static const struct {
    uint32_t code;
    const char *name;
} greek[] = {
    {0x00B5, "mu"},      {0x0391, "Alpha"},   {0x0392, "Beta"},  {0x0393, "Gamma"},
    {0x0394, "Delta"},   {0x0395, "Epsilon"}, {0x0396, "Zeta"},  {0x0397, "Eta"},
    {0x0398, "Theta"},   {0x0399, "Iota"},    {0x039A, "Kappa"}, {0x039B, "Lambda"},
    {0x039C, "Mu"},      {0x039D, "Nu"},      {0x039E, "Xi"},    {0x039F, "Omicron"},
    {0x03A0, "Pi"},      {0x03A1, "Rho"},     {0x03A3, "Sigma"}, {0x03A4, "Tau"},
    {0x03A5, "Upsilon"}, {0x03A6, "Phi"},     {0x03A7, "Chi"},   {0x03A8, "Psi"},
    {0x03A9, "Omega"},   {0x03B1, "alpha"},   {0x03B2, "beta"},  {0x03B3, "gamma"},
    {0x03B4, "delta"},   {0x03B5, "epsilon"}, {0x03B6, "zeta"},  {0x03B7, "eta"},
    {0x03B8, "theta"},   {0x03B9, "iota"},    {0x03BA, "kappa"}, {0x03BB, "lambda"},
    {0x03BC, "mu"},      {0x03BD, "nu"},      {0x03BE, "xi"},    {0x03BF, "omicron"},
    {0x03C0, "pi"},      {0x03C1, "rho"},     {0x03C2, "sigma"}, {0x03C3, "sigma"},
    {0x03C4, "tau"},     {0x03C5, "upsilon"}, {0x03C6, "phi"},   {0x03C7, "chi"},
    {0x03C8, "psi"},     {0x03C9, "omega"},   {0x03D1, "theta"}, {0x03D5, "phi"},
    {0x03D6, "pi"},      {0x03F0, "kappa"},   {0x03F1, "rho"},   {0x03F4, "Theta"},
    {0x03F5, "epsilon"}, {0x2126, "Omega"},   {0x221E, "infinity"},
};

const char *
qdot_letters_greek(uint32_t c)
{
    size_t low = 0, high = sizeof greek / sizeof *greek;

    while (low < high) {
        size_t middle = (low + high) / 2;

        if (greek[middle].code == c)
            return greek[middle].name;
        if (greek[middle].code < c)
            low = middle + 1;
        else
            high = middle;
    }
    return NULL;
}

bool
qdot_letters_latin(uint32_t c)
{
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') ||
           (c >= 0xC0 && c <= 0x24F && c != 0xD7 && c != 0xF7) ||
           (c >= 0x1E00 && c <= 0x1EFF);
}

int
qdot_letters_subscript(uint32_t c)
{
    return c >= 0x2080 && c <= 0x2089 ? (int)(c - 0x2080) : -1;
}

int
qdot_letters_superscript(uint32_t c)
{
    if (c == 0xB9)
        return 1;
    if (c == 0xB2 || c == 0xB3)
        return (int)(c - 0xB0);
    return c == 0x2070 || (c >= 0x2074 && c <= 0x2079) ? (int)(c - 0x2070) : -1;
}

/* Letters with dots for time derivatives; ä, ë, ï, ö, ü and ÿ are left out because words contain them. */
static const struct {
    const char *letter, *base;
    unsigned dots;
} dotted[] = {
    {"ȧ", "a", 1}, {"ḃ", "b", 1}, {"ċ", "c", 1}, {"ḋ", "d", 1}, {"ė", "e", 1}, {"ḟ", "f", 1},
    {"ġ", "g", 1}, {"ḣ", "h", 1}, {"ṁ", "m", 1}, {"ṅ", "n", 1}, {"ȯ", "o", 1}, {"ṗ", "p", 1},
    {"ṙ", "r", 1}, {"ṡ", "s", 1}, {"ṫ", "t", 1}, {"ẇ", "w", 1}, {"ẋ", "x", 1}, {"ẏ", "y", 1},
    {"ż", "z", 1}, {"Ȧ", "A", 1}, {"Ḃ", "B", 1}, {"Ċ", "C", 1}, {"Ḋ", "D", 1}, {"Ė", "E", 1},
    {"Ḟ", "F", 1}, {"Ġ", "G", 1}, {"Ḣ", "H", 1}, {"İ", "I", 1}, {"Ṁ", "M", 1}, {"Ṅ", "N", 1},
    {"Ȯ", "O", 1}, {"Ṗ", "P", 1}, {"Ṙ", "R", 1}, {"Ṡ", "S", 1}, {"Ṫ", "T", 1}, {"Ẇ", "W", 1},
    {"Ẋ", "X", 1}, {"Ẏ", "Y", 1}, {"Ż", "Z", 1}, {"ẍ", "x", 2}, {"ẅ", "w", 2}, {"ḧ", "h", 2},
    {"ẗ", "t", 2}, {"Ẍ", "X", 2}, {"Ẅ", "W", 2}, {"Ḧ", "H", 2},
};

unsigned
qdot_letters_dotted(const char *text, const char **letter)
{
    for (size_t i = 0; i < sizeof dotted / sizeof *dotted && (text[0] & 0x80); i++)
        if (strncmp(text, dotted[i].letter, strlen(dotted[i].letter)) == 0) {
            *letter = dotted[i].base;
            return dotted[i].dots;
        }
    return 0;
}

bool
qdot_subscript_means(const char *name, unsigned form, qdot_text *spelled)
{
    static const char *const forms[] = {"[%s]", "_%s"};
    size_t n = strlen(name), digits = 0;

    while (digits < n && strchr("0123456789", name[n - digits - 1]) != NULL)
        digits++;
    if (digits == 0 || digits == n || form >= sizeof forms / sizeof *forms)
        return false;
    qdot_text_truncate(spelled, 0);
    qdot_text_add_n(spelled, name, n - digits);
    qdot_text_format(spelled, forms[form], name + n - digits);
    return true;
}
