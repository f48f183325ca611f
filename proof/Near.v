(* SPDX-License-Identifier: MIT *)
(* Numbers that are known up to a relative error, and how the error grows. *)
From Coq Require Import Reals Lra Psatz ZArith.
From Flocq Require Import Core.
From Swivel Require Import Wrist Rounding.
Open Scope R_scope.

Definition near c x y := Rabs (x - y) <= c * y.
Lemma near_bounds c x y : near c x y -> (1 - c) * y <= x <= (1 + c) * y.
Proof. intro H. apply Rabs_le_inv in H. lra. Qed.
Lemma near_intro c x y : (1 - c) * y <= x <= (1 + c) * y -> near c x y.
Proof. intro H. apply Rabs_le. lra. Qed.
Lemma near_refl x : near 0 x x.
Proof. unfold near. rewrite Rminus_diag_eq, Rabs_R0; lra. Qed.
Lemma near_weaken c c' x y : 0 <= y -> c <= c' -> near c x y -> near c' x y.
Proof. unfold near. intros. assert (c * y <= c' * y) by (apply Rmult_le_compat_r; assumption). lra. Qed.
Lemma near_pos c x y : c <= 1 -> 0 <= y -> near c x y -> 0 <= x.
Proof. intros Hc Hy H. apply near_bounds in H. assert (0 <= (1 - c) * y) by (apply Rmult_le_pos; lra). lra. Qed.
Lemma near_mul c1 c2 c x1 y1 x2 y2 : 0 <= c1 <= 1 -> 0 <= c2 <= 1 -> 0 <= y1 -> 0 <= y2 -> c1 + c2 + c1 * c2 <= c ->
  near c1 x1 y1 -> near c2 x2 y2 -> near c (x1 * x2) (y1 * y2).
Proof.
  intros H1 H2 P1 P2 Hc N1 N2. apply near_bounds in N1. apply near_bounds in N2. apply near_intro.
  pose proof (Rmult_le_pos _ _ P1 P2) as P.
  assert (Q1 : 0 <= (1 - c1) * y1) by (apply Rmult_le_pos; lra).
    assert (Q2 : 0 <= (1 - c2) * y2) by (apply Rmult_le_pos; lra).
  assert (L : (1 - c1) * y1 * ((1 - c2) * y2) <= x1 * x2) by (apply Rmult_le_compat; lra).
  assert (U : x1 * x2 <= (1 + c1) * y1 * ((1 + c2) * y2)) by (apply Rmult_le_compat; lra).
  replace ((1 - c1) * y1 * ((1 - c2) * y2)) with ((1 - c1 - c2 + c1 * c2) * (y1 * y2)) in L by ring.
  replace ((1 + c1) * y1 * ((1 + c2) * y2)) with ((1 + c1 + c2 + c1 * c2) * (y1 * y2)) in U by ring.
  assert (0 <= c1 * c2) by (apply Rmult_le_pos; lra).
  split; eapply Rle_trans. 2: exact L. 2: exact U. all: apply Rmult_le_compat_r; lra.
Qed.
Lemma near_add c x1 y1 x2 y2 : near c x1 y1 -> near c x2 y2 -> near c (x1 + x2) (y1 + y2).
Proof. intros N1 N2. apply near_bounds in N1. apply near_bounds in N2. apply near_intro. lra. Qed.
Lemma near_fl c c' x y : 0 <= c <= 1 -> 0 <= y -> c + u + c * u <= c' -> relative x -> near c x y -> near c' (fl32 x) y.
Proof.
  intros Hc Hy Hc' [e [K ->]] N. pose proof (near_pos _ _ _ (proj2 Hc) Hy N) as P.
  rewrite <- (Rmult_1_r y). apply near_mul with c u; try lra; try exact N. rewrite u_val; lra.
  unfold near, ok in *. replace (1 + e - 1) with e by ring. lra.
Qed.
Lemma near_inv c c' x y : 0 <= c < 1 -> 0 < y -> c <= c' * (1 - c) -> near c x y -> near c' (1 / x) (1 / y).
Proof.
  intros Hc Hy Hc' N. apply near_bounds in N. assert (P : 0 < (1 - c) * y) by (apply Rmult_lt_0_compat; lra).
  assert (Px : 0 < x) by lra. unfold near.
  replace (1 / x - 1 / y) with ((y - x) * / (x * y)) by (field; lra).
  assert (Pi : 0 < / (x * y)) by (apply Rinv_0_lt_compat, Rmult_lt_0_compat; lra).
  rewrite Rabs_mult, (Rabs_right (/ (x * y))) by lra.
  apply Rmult_le_reg_r with (x * y). apply Rmult_lt_0_compat; lra.
  rewrite Rmult_assoc, Rinv_l, Rmult_1_r by (apply Rgt_not_eq, Rmult_lt_0_compat; lra).
  replace (c' * (1 / y) * (x * y)) with (c' * x) by (field; lra).
  assert (Rabs (y - x) <= c * y) by (apply Rabs_le; lra).
  assert (0 <= c') by (destruct (Rle_lt_dec 0 c') as [|L]; [assumption|];
    assert (c' * (1 - c) < 0) by (apply Ropp_lt_cancel; replace (- (c' * (1 - c))) with (- c' * (1 - c)) by ring;
    rewrite Ropp_0; apply Rmult_lt_0_compat; lra); lra).
  assert (c' * ((1 - c) * y) <= c' * x) by (apply Rmult_le_compat_l; lra).
  assert (c * y <= c' * (1 - c) * y) by (apply Rmult_le_compat_r; lra). lra.
Qed.
Lemma near_max c x1 y1 x2 y2 : 0 <= c <= 1 -> near c x1 y1 -> near c x2 y2 -> near c (Rmax x1 x2) (Rmax y1 y2).
Proof.
  intros Hc N1 N2. apply near_bounds in N1. apply near_bounds in N2. apply near_intro.
  unfold Rmax. destruct (Rle_dec x1 x2), (Rle_dec y1 y2).
  - lra.
  - split. apply Rle_trans with x1; lra. apply Rle_trans with (1 := proj2 N2). apply Rmult_le_compat_l; lra.
  - split. apply Rle_trans with x2; lra. apply Rle_trans with (1 := proj2 N1). apply Rmult_le_compat_l; lra.
  - lra.
Qed.
