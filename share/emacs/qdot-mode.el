;;; qdot-mode.el --- edit and run scripts of qdot -*- lexical-binding: t -*-

;; SPDX-License-Identifier: GPL-3.0-or-later

;;; Commentary:

;; Colours and comments for .lag files, and C-c C-c, which runs the file; an error of the
;; script is a place that `next-error' goes to.

;;; Code:

(require 'compile)

(defvar qdot-program "qdot"
  "The program that runs a script.")

;; What stands between `words' and `end' is written by tools/editors from the words that the
;; program itself lists.
;; words
(defconst qdot-statements
  '("abbreviate" "animate" "assume" "body" "check" "constraint" "continue" "coord"
    "cyclic" "damper" "derive" "dissipation" "dof" "equilibria" "event" "events" "export"
    "find" "fit" "floquet" "force" "forces" "function" "gravity" "help" "include"
    "lagrangian" "longtime" "lyapunov" "modes" "param" "particle" "plan" "plot" "poincare"
    "potential" "print" "quit" "race" "reactions" "redo" "remove" "report" "reset" "run"
    "save" "scale" "scene" "sensitivity" "set" "show" "spring" "start" "style" "sweep"
    "table" "timing" "torque" "undo" "vars" "workprecision")
  "Words at the beginning of a statement.")
(defconst qdot-functions
  '("N" "abs" "acos" "acosh" "asin" "asinh" "atan" "atan2" "atanh" "christoffel"
    "collect" "cos" "cosh" "cot" "cross" "csc" "curl" "ddt" "det" "diff" "divergence"
    "dot" "drift" "ds2" "eigenvalues" "erf" "erfc" "exp" "expand" "factor" "floor"
    "geodesic" "gradient" "if" "inverse" "laplacian" "latex" "lhs" "log" "max" "mean"
    "metric" "min" "mod" "norm" "numeric" "point" "poisson" "residual" "rhs" "ricci"
    "riemann" "routhian" "scalar_curvature" "scale_factors" "sec" "series" "sign"
    "simplify" "sin" "sinh" "size" "solve" "speed2" "spin" "sqrt" "stability" "subs" "sum"
    "tan" "tanh" "trace" "transpose" "value" "velocity" "volume_element")
  "The functions of the language.")
(defconst qdot-values
  '("H" "L" "Q" "T" "V" "accel" "conserved" "cyclic" "delta" "dof" "ds2" "energy" "eom"
    "equilibria" "forces" "hamiltonian" "kinetic" "lagrange_function" "lambda"
    "mass_matrix" "modes" "momenta" "p" "potential_energy" "reactions" "routhian" "speed2"
    "stable" "stable_to_first_order" "undecided" "unstable" "virtual_work")
  "The values of the language.")
;; end

(defconst qdot-options
  '("mass" "at" "on" "to" "inertia" "about" "angle" "euler" "rotation" "between" "stiffness"
    "rest" "coefficient" "material" "tol" "method" "as" "with" "digits" "constraints" "rising"
    "falling" "stop" "then" "every" "vs" "for" "when" "within" "exactly" "step" "count" "seed"
    "from" "range" "log" "title" "labels" "size" "keep" "such" "that" "of" "in")
  "Words that follow an operand.")

(defconst qdot-font-lock-keywords
  `((,(concat "\\(?:^\\|[;{]\\)[ \t]*\\(" (regexp-opt qdot-statements) "\\)\\_>")
     1 font-lock-keyword-face)
    (,(concat "[^ \t\n][ \t]+\\(" (regexp-opt qdot-options) "\\)\\_>")
     1 font-lock-builtin-face)
    (,(concat "\\_<\\(" (regexp-opt qdot-functions) "\\)[ \t]*(")
     1 font-lock-function-name-face)
    (,(regexp-opt qdot-values 'symbols) . font-lock-variable-name-face)
    ("\\_<\\(?:pi\\|t\\)\\_>" . font-lock-constant-face))
  "What is coloured, and how.")

(defvar qdot-mode-syntax-table
  (let ((table (make-syntax-table)))
    (modify-syntax-entry ?# "<" table)
    (modify-syntax-entry ?\n ">" table)
    (modify-syntax-entry ?_ "_" table)
    (modify-syntax-entry ?' "_" table)
    (modify-syntax-entry ?\" "\"" table)
    table)
  "Comments begin with #; a prime belongs to its name.")

(defun qdot-run-file ()
  "Save the file and run it."
  (interactive)
  (save-buffer)
  (compile (concat qdot-program " -q " (shell-quote-argument (buffer-file-name)))))

(defvar qdot-mode-map
  (let ((map (make-sparse-keymap)))
    (define-key map (kbd "C-c C-c") #'qdot-run-file)
    map)
  "Keys of `qdot-mode'.")

;;;###autoload
(define-derived-mode qdot-mode prog-mode "qdot"
  "Scripts of qdot, a workbench for Lagrangian mechanics."
  (setq-local comment-start "# ")
  (setq-local comment-start-skip "#+[ \t]*")
  (setq-local font-lock-defaults '(qdot-font-lock-keywords)))

;; FILE:LINE:COLUMN: error: is what compile.el knows as `gnu'.

;;;###autoload
(add-to-list 'auto-mode-alist '("\\.lag\\'" . qdot-mode))

(provide 'qdot-mode)

;;; qdot-mode.el ends here
