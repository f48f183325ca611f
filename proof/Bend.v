(* SPDX-License-Identifier: MIT *)
(* Ranges in arm_triangle: nothing underflows inexactly, and the lift's components are below 3.36e7. *)
From Coq Require Import Reals Lra Psatz ZArith.
From Flocq Require Import Core.
From Swivel Require Import Wrist Rounding Near.
Open Scope R_scope.

Section Triangle.
Variables far diff d longer shorter ahead behind a b p m sum per_sum ca sa ch sh top larger both ratio lift2 : R.
Let N := Rabs diff.
Hypotheses (Ffar : is_float far) (Fdiff : is_float diff) (Fd : is_float d).
Hypotheses (HN : N <= d) (HF : d <= far) (Hd : d = far \/ 3e-5 <= d) (Hmost : far <= 3.6e7)
  (Hleast : 9.9e-10 <= far - N).
Hypotheses (Xlo : longer = fl32 (far + d)) (Xsh : shorter = fl32 (far - d)) (Xah : ahead = fl32 (d + diff))
  (Xbh : behind = fl32 (d - diff)).
Hypotheses (Xa : a = fl32 (behind * ahead)) (Xb : b = fl32 (shorter * longer)) (Xp : p = fl32 (ahead * longer))
  (Xm : m = fl32 (behind * shorter)).
Hypotheses (Xs : sum = fl32 (a + b)) (Xr : per_sum = fl32 (1 / sum)).
Hypotheses (Xca : ca = fl32 (a * per_sum)) (Xsa : sa = fl32 (b * per_sum)) (Xch : ch = fl32 (sqrt ca))
  (Xsq : sh = fl32 (sqrt sa)).
Hypotheses (Xtop : top = Rmax p m) (Xlg : larger = fl32 (top * per_sum)).
Hypotheses (Xbo : both = fl32 (p + m)) (Xra : ratio = fl32 (both * per_sum)) (Xl2 : lift2 = fl32 (larger * ratio)).

Lemma sides : - N <= diff <= N /\ 0 <= N.
Proof. unfold N. unfold Rabs; destruct (Rcase_abs diff); lra. Qed.
Lemma diff_side : diff = N \/ diff = - N.
Proof. unfold N. unfold Rabs; destruct (Rcase_abs diff); lra. Qed.
Lemma far_pos : 9.9e-10 <= far.
Proof. pose proof sides. lra. Qed.
Lemma d_pos : 9.9e-10 <= d.
Proof. pose proof far_pos. destruct Hd; lra. Qed.
Lemma gap_far : d = far \/ 5.96e-8 * far <= far - d.
Proof. pose proof d_pos. destruct (Req_dec d far) as [E|E]. left; exact E. right. pose proof (float_gap far d Ffar Fd).
  lra. Qed.
Lemma float_N : is_float N.
Proof. unfold N, is_float. now apply Generic_fmt.generic_format_abs. Qed.
Lemma gap_near : d = N \/ 5.96e-8 * d <= d - N.
Proof. pose proof sides. destruct (Req_dec d N) as [E|E]. left; exact E. right. pose proof (float_gap d N Fd float_N).
  lra. Qed.
Lemma gap_bones : 5.96e-8 * far <= far - N.
Proof. pose proof sides. pose proof (float_gap far N Ffar float_N). lra. Qed.

Lemma rel_longer : relative (far + d). Proof. now apply relative_sum. Qed.
Lemma rel_shorter : relative (far - d). Proof. now apply relative_difference. Qed.
Lemma rel_ahead : relative (d + diff). Proof. now apply relative_sum. Qed.
Lemma rel_behind : relative (d - diff). Proof. now apply relative_difference. Qed.
Lemma near_one x : relative x -> 0 <= x -> near 6e-8 (fl32 x) x.
Proof. intros. apply near_fl with 0; try assumption; try lra. rewrite u_val; lra. apply near_refl. Qed.
Lemma n_longer : near 6e-8 longer (far + d). Proof. rewrite Xlo. apply near_one. apply rel_longer.
  pose proof far_pos; pose proof d_pos; lra. Qed.
Lemma n_shorter : near 6e-8 shorter (far - d). Proof. rewrite Xsh. apply near_one. apply rel_shorter. lra. Qed.
Lemma n_ahead : near 6e-8 ahead (d + diff). Proof. rewrite Xah. apply near_one. apply rel_ahead. pose proof sides. lra.
  Qed.
Lemma n_behind : near 6e-8 behind (d - diff). Proof. rewrite Xbh. apply near_one. apply rel_behind. pose proof sides.
  lra. Qed.

(* the factors are zero, or not small *)
Definition sizeable x := x = 0 \/ 1.1e-19 <= Rabs x.
Lemma sizeable_intro x : x = 0 \/ 1.1e-19 <= x -> sizeable x.
Proof. intros [H|H]; [left|right]. exact H. rewrite Rabs_right; lra. Qed.
Lemma sizeable_mul x y : sizeable x -> sizeable y -> relative (x * y).
Proof.
  intros [->|Hx] [->|Hy]; apply relative_large; try (left; ring). right. rewrite Rabs_mult.
  apply Rle_trans with (1.1e-19 * 1.1e-19). lra. apply Rmult_le_compat; lra.
Qed.
Lemma s_longer : sizeable longer. Proof. pose proof (near_bounds _ _ _ n_longer). pose proof far_pos. pose proof d_pos.
  apply sizeable_intro. right. lra. Qed.
Lemma near_zero c x : near c x 0 -> x = 0.
Proof. intro H. apply near_bounds in H. lra. Qed.
Lemma s_shorter : sizeable shorter.
Proof.
  pose proof n_shorter as H. pose proof far_pos. apply sizeable_intro. destruct gap_far as [E|E].
  - left. apply (near_zero 6e-8). replace 0 with (far - d) by lra. exact H.
  - right. apply near_bounds in H. lra.
Qed.
Lemma sizeable_side x : x = d + N \/ x = d - N -> near 6e-8 (fl32 x) x -> sizeable (fl32 x).
Proof.
  intros E H. pose proof d_pos. pose proof sides. apply sizeable_intro. destruct E as [E|E].
  - right. apply near_bounds in H. lra.
  - destruct gap_near as [G|G].
    + left. apply (near_zero 6e-8). replace 0 with x by lra. exact H.
    + right. apply near_bounds in H. lra.
Qed.
Lemma s_ahead : sizeable ahead.
Proof. pose proof n_ahead as H. rewrite Xah in *. apply sizeable_side; [destruct diff_side; lra|exact H]. Qed.
Lemma s_behind : sizeable behind.
Proof. pose proof n_behind as H. rewrite Xbh in *. apply sizeable_side; [destruct diff_side; lra|exact H]. Qed.
Lemma rel_a : relative (behind * ahead). Proof. apply sizeable_mul. apply s_behind. apply s_ahead. Qed.
Lemma rel_b : relative (shorter * longer). Proof. apply sizeable_mul. apply s_shorter. apply s_longer. Qed.
Lemma rel_p : relative (ahead * longer). Proof. apply sizeable_mul. apply s_ahead. apply s_longer. Qed.
Lemma rel_m : relative (behind * shorter). Proof. apply sizeable_mul. apply s_behind. apply s_shorter. Qed.

(* the exact products *)
Let A := (d - diff) * (d + diff).
Let B := (far - d) * (far + d).
Let P := (d + diff) * (far + d).
Let M := (d - diff) * (far - d).
Let G := (far - N) * (far + N).
Lemma AB : A + B = G.
Proof. unfold A, B, G. assert (diff * diff = N * N) by (destruct diff_side as [E|E]; rewrite E at 1 2; ring). lra. Qed.
Lemma PM : P + M = 2 * d * (far + diff).
Proof. unfold P, M. ring. Qed.
Lemma factors : 0 <= d - diff /\ 0 <= d + diff /\ 0 <= far - d /\ 0 <= far + d.
Proof. pose proof sides. pose proof far_pos. pose proof d_pos. lra. Qed.
Lemma positive : 0 <= A /\ 0 <= B /\ 0 <= P /\ 0 <= M /\ 9e-19 <= G.
Proof.
  destruct factors as [F1 [F2 [F3 F4]]]. unfold A, B, P, M. repeat split; try (apply Rmult_le_pos; assumption).
  unfold G. pose proof sides. pose proof far_pos. apply Rle_trans with (9.9e-10 * 9.9e-10). lra.
    apply Rmult_le_compat; lra.
Qed.
Lemma near_product x1 y1 x2 y2 : 0 <= y1 -> 0 <= y2 -> near 6e-8 x1 y1 -> near 6e-8 x2 y2 -> relative (x1 * x2) ->
  near 1.9e-7 (fl32 (x1 * x2)) (y1 * y2).
Proof.
  intros. apply near_fl with 1.21e-7; try assumption; try lra. now apply Rmult_le_pos. rewrite u_val; lra.
  apply near_mul with 6e-8 6e-8; try assumption; lra.
Qed.
Lemma n_a : near 1.9e-7 a A. Proof. rewrite Xa. destruct factors as [? [? [? ?]]]. apply near_product; try assumption.
  apply n_behind. apply n_ahead. apply rel_a. Qed.
Lemma n_b : near 1.9e-7 b B. Proof. rewrite Xb. destruct factors as [? [? [? ?]]]. apply near_product; try assumption.
  apply n_shorter. apply n_longer. apply rel_b. Qed.
Lemma n_p : near 1.9e-7 p P. Proof. rewrite Xp. destruct factors as [? [? [? ?]]]. apply near_product; try assumption.
  apply n_ahead. apply n_longer. apply rel_p. Qed.
Lemma n_m : near 1.9e-7 m M. Proof. rewrite Xm. destruct factors as [? [? [? ?]]]. apply near_product; try assumption.
  apply n_behind. apply n_shorter. apply rel_m. Qed.
Lemma f_a : is_float a. Proof. rewrite Xa. apply float_fl. Qed.
Lemma f_b : is_float b. Proof. rewrite Xb. apply float_fl. Qed.
Lemma f_p : is_float p. Proof. rewrite Xp. apply float_fl. Qed.
Lemma f_m : is_float m. Proof. rewrite Xm. apply float_fl. Qed.
Lemma n_sum : near 2.6e-7 sum G.
Proof.
  rewrite Xs, <- AB. destruct positive as [? [? _]]. apply near_fl with 1.9e-7; try lra. rewrite u_val; lra.
    apply relative_sum. apply f_a. apply f_b.
  apply near_add. apply n_a. apply n_b.
Qed.
Lemma n_both : near 2.6e-7 both (P + M).
Proof.
  rewrite Xbo. destruct positive as [_ [_ [? [? _]]]]. apply near_fl with 1.9e-7; try lra. rewrite u_val; lra.
    apply relative_sum. apply f_p. apply f_m.
  apply near_add. apply n_p. apply n_m.
Qed.
Lemma G_most : G <= 1.3e15.
Proof. unfold G. pose proof sides. pose proof far_pos. pose proof gap_bones.
  replace ((far - N) * (far + N)) with (far * far - N * N) by ring.
  assert (far * far <= 3.6e7 * 3.6e7) by (apply Rmult_le_compat; lra). pose proof (Rle_0_sqr N) as Q. unfold Rsqr in Q.
    lra. Qed.
Lemma sum_range : 8e-19 <= sum <= 1.4e15.
Proof. pose proof (near_bounds _ _ _ n_sum). destruct positive as [_ [_ [_ [_ ?]]]]. pose proof G_most. lra. Qed.
Lemma inverse_range : 7e-16 <= 1 / sum <= 1.3e18.
Proof.
  pose proof sum_range as [S1 S2]. unfold Rdiv. rewrite Rmult_1_l. split.
  - apply Rle_trans with (/ 1.4e15). lra. apply Rinv_le_contravar; lra.
  - apply Rle_trans with (/ 8e-19). apply Rinv_le_contravar; lra. lra.
Qed.
Lemma rel_inverse : relative (1 / sum).
Proof. apply relative_large. right. pose proof inverse_range. rewrite Rabs_right; lra. Qed.
Let g := 1 / G.
Lemma g_pos : 0 < g. Proof. unfold g. destruct positive as [_ [_ [_ [_ ?]]]]. apply Rdiv_lt_0_compat; lra. Qed.
Lemma Gg : G * g = 1. Proof. unfold g. destruct positive as [_ [_ [_ [_ ?]]]]. field. lra. Qed.
Lemma n_r : near 3.3e-7 per_sum g.
Proof.
  pose proof g_pos. rewrite Xr. apply near_fl with 2.61e-7; try lra. rewrite u_val; lra. apply rel_inverse.
  destruct positive as [_ [_ [_ [_ ?]]]]. unfold g. apply near_inv with 2.6e-7; try lra. apply n_sum.
Qed.
Lemma r_pos : 0 < per_sum. Proof. pose proof (near_bounds _ _ _ n_r). pose proof g_pos. lra. Qed.

(* the quotients *)
Lemma below_far2 : G <= far * far.
Proof. unfold G. replace ((far - N) * (far + N)) with (far * far - N * N) by ring. pose proof (Rle_0_sqr N) as Q.
  unfold Rsqr in Q. lra. Qed.
Lemma times_g x y : x * G <= y -> x <= y * g.
Proof. intro H. pose proof g_pos. replace x with (x * G * g) by (rewrite Rmult_assoc, Gg; ring).
  apply Rmult_le_compat_r; lra. Qed.
Lemma times_g' x y : y <= x * G -> y * g <= x.
Proof. intro H. pose proof g_pos. replace x with (x * G * g) by (rewrite Rmult_assoc, Gg; ring).
  apply Rmult_le_compat_r; lra. Qed.
Lemma A_least : A = 0 \/ 4e-32 <= A * g.
Proof.
  destruct Hd as [E|L].
  - right. apply times_g. rewrite <- AB. assert (B = 0) by (unfold B; rewrite E; ring). destruct positive as [? _]. lra.
  - assert (EA : A = (d - N) * (d + N)) by (unfold A; destruct diff_side as [Q|Q]; rewrite Q at 1 2; ring).
    destruct gap_near as [Q|Q].
    + left. rewrite EA, Q. ring.
    + right. apply times_g. pose proof G_most. pose proof sides. rewrite EA.
      assert (5.96e-8 * 3e-5 * 3e-5 <= (d - N) * (d + N)) by (apply Rmult_le_compat; lra). lra.
Qed.
Lemma B_least : B = 0 \/ 5.9e-8 <= B * g.
Proof.
  destruct gap_far as [E|E].
  - left. unfold B. rewrite E. ring.
  - right. apply times_g. apply Rle_trans with (5.96e-8 * far * far). pose proof below_far2.
    pose proof (Rle_0_sqr far) as Q. unfold Rsqr in Q. lra.
    unfold B. pose proof far_pos. pose proof d_pos. apply Rmult_le_compat; lra.
Qed.
Lemma quotient_relative c x y e : 0 <= y -> 1e-37 <= e -> near c x y -> c <= 1e-3 -> y = 0 \/ e <= y * g ->
  relative (x * per_sum).
Proof.
  intros Hy He N' Hc [E|E]; apply relative_large.
  - left. rewrite E in N'. rewrite (near_zero _ _ N'). ring.
  - right. pose proof g_pos. apply near_bounds in N'. pose proof (near_bounds _ _ _ n_r) as R.
    assert (0.9 * (y * g) <= x * per_sum).
    { assert ((1 - 1e-3) * y <= (1 - c) * y) by (apply Rmult_le_compat_r; lra).
      assert (0.95 * y * (0.95 * g) <= x * per_sum) by (apply Rmult_le_compat; lra).
      assert (0 <= y * g) by (apply Rmult_le_pos; lra). lra. }
    rewrite Rabs_right; lra.
Qed.
Lemma rel_ca : relative (a * per_sum).
Proof. apply quotient_relative with 1.9e-7 A 4e-32; try lra. apply positive. apply n_a. apply A_least. Qed.
Lemma rel_sa : relative (b * per_sum).
Proof. apply quotient_relative with 1.9e-7 B 5.9e-8; try lra. apply positive. apply n_b. apply B_least. Qed.
Lemma near_quotient c x y : 0 <= c <= 3e-7 -> 0 <= y -> near c x y -> relative (x * per_sum) ->
  near (c + 4e-7) (fl32 (x * per_sum)) (y * g).
Proof.
  intros Hc Hy H R. pose proof g_pos. assert (0 <= y * g) by (apply Rmult_le_pos; lra).
  assert (c * 3.3e-7 <= 1e-12) by (apply Rle_trans with (3e-7 * 3.3e-7); [apply Rmult_le_compat_r|]; lra).
  apply near_fl with (c + 3.301e-7); try lra; try exact R. rewrite u_val; lra.
  apply near_mul with c 3.3e-7; try assumption; try lra. apply n_r.
Qed.
Lemma n_ca : near 6e-7 ca (A * g). Proof. destruct positive as [? _]. pose proof g_pos. rewrite Xca.
  apply near_weaken with (1.9e-7 + 4e-7); try lra. apply Rmult_le_pos; lra.
  apply near_quotient; try lra. apply n_a. apply rel_ca. Qed.
Lemma n_sa : near 6e-7 sa (B * g). Proof. destruct positive as [_ [? _]]. pose proof g_pos. rewrite Xsa.
  apply near_weaken with (1.9e-7 + 4e-7); try lra. apply Rmult_le_pos; lra.
  apply near_quotient; try lra. apply n_b. apply rel_sa. Qed.
Lemma A_most : A * g <= 1. Proof. apply times_g'. rewrite <- AB. destruct positive as [_ [? _]]. lra. Qed.
Lemma B_most : B * g <= 1. Proof. apply times_g'. rewrite <- AB. destruct positive as [? _]. lra. Qed.
Lemma ca_range : 0 <= ca <= 1.001 /\ (ca = 0 \/ 3e-32 <= ca).
Proof.
  destruct positive as [PA _]. pose proof g_pos. assert (0 <= A * g) by (apply Rmult_le_pos; lra).
    pose proof n_ca as NC. pose proof A_most.
  split. apply near_bounds in NC; lra. destruct A_least as [E|E].
  - left. rewrite E, Rmult_0_l in NC. now apply near_zero in NC.
  - right. apply near_bounds in NC. lra.
Qed.
Lemma sa_range : 0 <= sa <= 1.001 /\ (sa = 0 \/ 5e-8 <= sa).
Proof.
  destruct positive as [_ [PB _]]. pose proof g_pos. assert (0 <= B * g) by (apply Rmult_le_pos; lra).
    pose proof n_sa as NC. pose proof B_most.
  split. apply near_bounds in NC; lra. destruct B_least as [E|E].
  - left. rewrite E, Rmult_0_l in NC. now apply near_zero in NC.
  - right. apply near_bounds in NC. lra.
Qed.
Lemma root_range x e : 0 <= x <= 1.001 -> (x = 0 \/ e * e <= x) -> 1e-37 <= e ->
  relative (sqrt x) /\ 0 <= fl32 (sqrt x) <= 1.01 /\ (fl32 (sqrt x) = 0 \/ 0.99 * e <= fl32 (sqrt x)).
Proof.
  intros Hx Hs He. assert (S : sqrt x <= 1.001). { rewrite <- (sqrt_square 1.001) by lra. apply sqrt_le_1_alt. lra. }
  pose proof (sqrt_pos x) as S0.
  assert (L : sqrt x = 0 \/ e <= sqrt x). { destruct Hs as [->|Hs]. left. apply sqrt_0. right.
    rewrite <- (sqrt_square e) by lra. now apply sqrt_le_1_alt. }
  assert (Rl : relative (sqrt x)). { apply relative_large. destruct L as [L|L]; [left; exact L|right].
    rewrite Rabs_right; lra. }
  pose proof (near_one _ Rl S0) as Q. split; [exact Rl|]. pose proof (near_bounds _ _ _ Q). split. lra.
  destruct L as [L|L]; [left; rewrite L in Q at 2; now apply near_zero in Q|right; lra].
Qed.
Lemma ch_facts : relative (sqrt ca) /\ 0 <= ch <= 1.01 /\ (ch = 0 \/ 0.99 * 1.5e-16 <= ch).
Proof. rewrite Xch. destruct ca_range as [C1 C2]. apply root_range; try lra. Qed.
Lemma sh_facts : relative (sqrt sa) /\ 0 <= sh <= 1.01 /\ (sh = 0 \/ 0.99 * 2e-4 <= sh).
Proof. rewrite Xsq. destruct sa_range as [C1 C2]. apply root_range; try lra. Qed.
Lemma rel_smaller : relative (ch * sh).
Proof. destruct ch_facts as [_ [_ C]]. destruct sh_facts as [_ [_ S]]. apply sizeable_mul; apply sizeable_intro; lra.
  Qed.

(* d over the smaller bone or the larger *)
Lemma both_g : (P + M) * g <= 3.3558e7 /\ (1/2 <= (P + M) * g \/ 8e-13 <= (P + M) * g).
Proof.
  pose proof sides as [S1 S2]. pose proof gap_bones. pose proof far_pos. pose proof d_pos. rewrite PM. split.
  - apply times_g'. unfold G. assert (2 * d * (far + diff) <= 2 * far * (far + N)) by (apply Rmult_le_compat; lra).
    assert (2 * far * (far + N) <= 3.3558e7 * (far - N) * (far + N)) by (apply Rmult_le_compat_r; lra). lra.
  - assert (T : forall t, 0 <= t -> t * (far + N) <= 2 * d -> t <= 2 * d * (far + diff) * g).
    { intros t Ht T0. apply times_g. unfold G. assert (t * (far + N) * (far - N) <= 2 * d * (far + diff)) by (apply
      Rmult_le_compat; try lra; apply Rmult_le_pos; lra). lra. }
    destruct Hd as [E|L]; [left|right]; apply T; lra.
Qed.
Lemma both_pos : 8e-13 <= (P + M) * g. Proof. destruct both_g as [_ [H|H]]; lra. Qed.
Lemma top_near : near 1.9e-7 top (Rmax P M).
Proof. rewrite Xtop. apply near_max. lra. apply n_p. apply n_m. Qed.
Lemma top_share : (P + M) / 2 <= Rmax P M <= P + M.
Proof. destruct positive as [_ [_ [? [? _]]]]. unfold Rmax. destruct (Rle_dec P M); lra. Qed.
Lemma top_g : 4e-13 <= Rmax P M * g <= 3.3558e7.
Proof.
  pose proof top_share as [T1 T2]. pose proof both_g as [U _]. pose proof both_pos. pose proof g_pos.
  assert ((P + M) / 2 * g <= Rmax P M * g) by (apply Rmult_le_compat_r; lra).
    assert (Rmax P M * g <= (P + M) * g) by (apply Rmult_le_compat_r; lra). lra.
Qed.
Lemma top_pos : 0 <= Rmax P M. Proof. pose proof top_share. destruct positive as [_ [_ [? [? _]]]]. lra. Qed.
Lemma rel_larger : relative (top * per_sum).
Proof. apply quotient_relative with 1.9e-7 (Rmax P M) 4e-13; try lra. apply top_pos. apply top_near. right.
  apply top_g. Qed.
Lemma n_larger : near 6e-7 larger (Rmax P M * g).
Proof. pose proof top_g. rewrite Xlg. apply near_weaken with (1.9e-7 + 4e-7); try lra. apply near_quotient; try lra.
  apply top_pos. apply top_near. apply rel_larger. Qed.
Lemma larger_range : 3.9e-13 <= larger <= 3.3559e7.
Proof. pose proof (near_bounds _ _ _ n_larger). pose proof top_g. lra. Qed.
Lemma rel_ratio : relative (both * per_sum).
Proof. destruct positive as [_ [_ [? [? _]]]]. apply quotient_relative with 2.6e-7 (P + M) 8e-13; try lra.
  apply n_both. right. apply both_pos. Qed.
Lemma n_ratio : near 7e-7 ratio ((P + M) * g).
Proof. destruct positive as [_ [_ [? [? _]]]]. pose proof both_pos. rewrite Xra.
  apply near_weaken with (2.6e-7 + 4e-7); try lra. apply near_quotient; try lra. apply n_both. apply rel_ratio. Qed.
Lemma ratio_range : 7.9e-13 <= ratio <= 3.3559e7.
Proof. pose proof (near_bounds _ _ _ n_ratio). pose proof both_pos. pose proof both_g as [? _]. lra. Qed.
Lemma rel_lift2 : relative (larger * ratio).
Proof. pose proof larger_range. pose proof ratio_range. apply sizeable_mul; apply sizeable_intro; right; lra. Qed.
Lemma lift2_range : 3e-25 <= lift2 <= 1.1263e15.
Proof.
  pose proof larger_range. pose proof ratio_range. assert (3.9e-13 * 7.9e-13 <= larger * ratio) by (apply
    Rmult_le_compat; lra).
  assert (larger * ratio <= 3.3559e7 * 3.3559e7) by (apply Rmult_le_compat; lra).
  pose proof (near_one _ rel_lift2 ltac:(lra)) as Q. apply near_bounds in Q. rewrite <- Xl2 in Q. lra.
Qed.
End Triangle.
