(* SPDX-License-Identifier: MIT *)
(* arm_triangle (core/solve_arm.h) and the lift: with every operation a factor 1 + e, the bent arm, lifted, ends near (0,
  0, d).
   Forward kinematics is defined here: bent is the arm in its plane, wrist_fk turns it by the shoulder's rotor. *)
From Coq Require Import Reals Lra Psatz.
From Coquelicot Require Import Coquelicot.
From Swivel Require Import Rotors Products Triangle.
Open Scope R_scope.

(* forward kinematics in exact reals; lengths of rotors are divided out *)
Definition bent c s L1 L2 := vadd (v3 0 0 L1) (rot (q4 c (- s) 0 0) (v3 0 0 L2)).
Definition wrist_fk q c s L1 L2 := rot q (bent c s L1 L2).
(* solve_arm.h: hinge(flip_sign(first, side), second) *)
Definition lift_q (sg lc ls : R) := if Rlt_dec sg 0 then q4 (- ls) lc 0 0 else q4 lc ls 0 0.

Lemma ln1p u e : 0 <= u -> u < 1/2 -> Rabs e <= u -> Rabs (ln (1 + e)) <= u / (1 - u).
Proof.
  intros Hu Hu2 He. apply Rabs_le_between in He.
  assert (U : forall x, -1 < x -> ln (1 + x) <= x).
  { intros x Hx. destruct (Req_dec x 0) as [->|N]. rewrite Rplus_0_r, ln_1; lra.
    apply Rle_trans with (ln (exp x)). 2: rewrite ln_exp; lra. left. apply ln_increasing. lra. apply exp_ineq1. lra. }
  assert (B : u <= u/(1-u)). { apply Rmult_le_reg_r with (1-u). lra. unfold Rdiv. rewrite Rmult_assoc, Rinv_l by lra.
    nra. }
  apply Rabs_le. split.
  - assert (E : ln (1+e) = - ln (1 + - (e/(1+e)))). { rewrite <- ln_Rinv. f_equal. field. lra.
      replace (1 + - (e/(1+e))) with (/(1+e)) by (field; lra). apply Rinv_0_lt_compat. lra. }
    rewrite E. apply Ropp_le_contravar. apply Rle_trans with (- (e/(1+e))).
    + apply U. assert (e/(1+e) < 1). { apply Rmult_lt_reg_r with (1+e). lra. unfold Rdiv.
      rewrite Rmult_assoc, Rinv_l by lra. lra. } lra.
    + apply Rmult_le_reg_r with ((1+e)*(1-u)). nra. replace (-(e/(1+e))*((1+e)*(1-u))) with (-e*(1-u)) by (field; lra).
      replace (u/(1-u)*((1+e)*(1-u))) with (u*(1+e)) by (field; lra). nra.
  - apply Rle_trans with (1 := U e ltac:(lra)). lra.
Qed.
Lemma ln_sqrt' x : 0 < x -> ln (sqrt x) = ln x / 2.
Proof. intro H. rewrite <- exp_half_ln by assumption. apply ln_exp. Qed.
Lemma pair_ang c s : 0 < c -> 0 < s ->
  (c*c - s*s)/(c*c + s*s) = cos (ang (ln s - ln c)) /\ 2*c*s/(c*c + s*s) = sin (ang (ln s - ln c)).
Proof.
  intros Hc Hs. assert (T : 0 < (s/c)*(s/c)) by (apply Rmult_lt_0_compat; now apply Rdiv_lt_0_compat).
  destruct (cos_ang _ T) as [C S].
  assert (E : ln (s/c*(s/c)) / 2 = ln s - ln c).
  { assert (E1 : ln (s/c) = ln s - ln c) by (unfold Rdiv; rewrite ln_mult by (try apply Rinv_0_lt_compat; assumption);
    rewrite ln_Rinv by assumption; ring).
    rewrite ln_mult by now apply Rdiv_lt_0_compat. rewrite E1. field. }
  rewrite E in C, S. rewrite C, S. rewrite sqrt_square by (left; now apply Rdiv_lt_0_compat). split. field.
    repeat split; nra. field; repeat split; nra.
Qed.
Lemma bent_eq c s L1 L2 : 0 < c*c + s*s -> bent c s L1 L2 = v3 0 (L2 * (2*c*s/(c*c+s*s))) (L1 + L2 * ((c*c -
  s*s)/(c*c+s*s))).
Proof. intro H. unfold bent, vadd, rot, sand, vscale, q2n; simpl. f_equal; field; nra. Qed.
Lemma lift_eq sg lc ls y z : sg = 1 \/ sg = -1 -> 0 < lc*lc + ls*ls ->
  rot (lift_q sg lc ls) (v3 0 y z) = v3 0 (sg * ((lc*lc-ls*ls)/(lc*lc+ls*ls) * y - 2*lc*ls/(lc*lc+ls*ls) * z))
                                          (sg * (2*lc*ls/(lc*lc+ls*ls) * y + (lc*lc-ls*ls)/(lc*lc+ls*ls) * z)).
Proof.
  intros [->| ->] H; unfold lift_q; destruct (Rlt_dec _ 0); try lra; unfold rot, sand, vscale, q2n; simpl; f_equal;
    field; nra.
Qed.
Lemma lift_q2n sg lc ls : q2n (lift_q sg lc ls) = lc*lc + ls*ls.
Proof. unfold lift_q; destruct (Rlt_dec sg 0); unfold q2n; simpl; ring. Qed.

(* nine roundings at most, in tau, mu and tau - mu alike: this is where 9 u comes from *)
Lemma nine l1 l2 l3 l4 l5 l6 l7 l8 l9 l10 l11 l12 l13 l14 K :
  -K <= l1 <= K -> -K <= l2 <= K -> -K <= l3 <= K -> -K <= l4 <= K -> -K <= l5 <= K -> -K <= l6 <= K ->
    -K <= l7 <= K -> -K <= l8 <= K ->
  -K <= l9 <= K -> -K <= l10 <= K -> -K <= l11 <= K -> -K <= l12 <= K -> -K <= l13 <= K -> -K <= l14 <= K ->
  let tau := (l3 + l4 + l6 + l10 - l1 - l2 - l5 - l9)/2 + l12 - l11 in
  let mp := (l3 - l4 + l1 - l2 + l5 + l6 + l9 + l10)/2 + l11 + l12 + l13 - l7 - l14 in
  let mm := (l1 + l3 - l2 - l4 - l5 - l6 - l9 - l10)/2 - l11 - l12 - l13 + l8 + l14 in
  (Rabs tau <= 9*K /\ Rabs mp <= 9*K /\ Rabs (tau - mp) <= 9*K) /\ (Rabs mm <= 9*K /\ Rabs (tau - mm) <= 9*K).
Proof. intros; repeat split; apply Rabs_le; unfold tau, mp, mm; split; lra. Qed.

Section Rounded.
Variables (u F D d : R) (e1 e2 e3 e4 e5 e6 e7 e8 e9 e10 e11 e12 e13 e14 r : R).
Hypothesis Hu : 0 <= u < 1/2.
Hypotheses (H1 : Rabs e1 <= u) (H2 : Rabs e2 <= u) (H3 : Rabs e3 <= u) (H4 : Rabs e4 <= u) (H5 : Rabs e5 <= u)
  (H6 : Rabs e6 <= u) (H7 : Rabs e7 <= u) (H8 : Rabs e8 <= u) (H9 : Rabs e9 <= u) (H10 : Rabs e10 <= u)
  (H11 : Rabs e11 <= u) (H12 : Rabs e12 <= u) (H13 : Rabs e13 <= u) (H14 : Rabs e14 <= u).
Hypothesis Hr : 0 < r.   (* per_sum; its own roundings do not matter for the wrist *)
(* arm_triangle, line by line *)
Definition behind := (d - D) * (1 + e1).
Definition ahead := (d + D) * (1 + e2).
Definition shorter := (F - d) * (1 + e3).
Definition longer := (F + d) * (1 + e4).
Definition a := behind * ahead * (1 + e5).
Definition b := shorter * longer * (1 + e6).
Definition p := ahead * longer * (1 + e7).
Definition m := behind * shorter * (1 + e8).
Definition ch := sqrt (a * r * (1 + e9)) * (1 + e11).
Definition sh := sqrt (b * r * (1 + e10)) * (1 + e12).
Definition smaller := ch * sh * (1 + e13).
Definition larger (top : R) := top * r * (1 + e14).   (* top = hi (p, m) *)
Let K := u / (1 - u).

Ltac pos := repeat first [ assumption | apply Rmult_lt_0_compat | apply sqrt_lt_R0 ].

Theorem elbow_inner L1 L2 sg : 0 < d -> Rabs D < d -> d < F -> sg = 1 \/ sg = -1 ->
  forall lc ls, (lc = larger p /\ ls = smaller) \/ (lc = smaller /\ ls = larger m) ->
  vnorm (vsub (rot (lift_q sg lc ls) (bent ch sh L1 L2)) (v3 0 0 (sg * d)))
    <= 9 * K * F + (Rabs (L1 - (F+D)/2) + Rabs (L2 - (F-D)/2)).
Proof.
  intros Hd HD HF Hsg lc ls Hl.
  assert (HK : 0 <= K). { unfold K. apply Rmult_le_pos. lra. left. apply Rinv_0_lt_compat. lra. }
  destruct (triangle_closes F D d Hd HD HF) as [E0 Ed].
  pose proof HD as HD'. apply Rabs_def2 in HD'.
  assert (G1 : 0 < d - D) by lra. assert (G2 : 0 < d + D) by lra. assert (G3 : 0 < F - d) by lra.
    assert (G4 : 0 < F + d) by lra.

  assert (N : forall e, Rabs e <= u -> 0 < 1 + e). { intros e He. apply Rabs_le_between in He. lra. }
  pose proof (N _ H1). pose proof (N _ H2). pose proof (N _ H3). pose proof (N _ H4). pose proof (N _ H5).
    pose proof (N _ H6). pose proof (N _ H7).
  pose proof (N _ H8). pose proof (N _ H9). pose proof (N _ H10). pose proof (N _ H11). pose proof (N _ H12).
    pose proof (N _ H13). pose proof (N _ H14).
  assert (P1 : 0 < behind) by (unfold behind; pos). assert (P2 : 0 < ahead) by (unfold ahead; pos).
  assert (P3 : 0 < shorter) by (unfold shorter; pos). assert (P4 : 0 < longer) by (unfold longer; pos).
  assert (Pa : 0 < a) by (unfold a; pos). assert (Pb : 0 < b) by (unfold b; pos).
    assert (Pp : 0 < p) by (unfold p; pos). assert (Pm : 0 < m) by (unfold m; pos).
  assert (Pc : 0 < ch) by (unfold ch; pos). assert (Ps : 0 < sh) by (unfold sh; pos).
    assert (Psm : 0 < smaller) by (unfold smaller; pos).
  (* logarithms *)
  assert (Lbh : ln behind = ln (d - D) + ln (1+e1)) by (unfold behind; rewrite ln_mult by assumption; reflexivity).
  assert (Lah : ln ahead = ln (d + D) + ln (1+e2)) by (unfold ahead; rewrite ln_mult by assumption; reflexivity).
  assert (Lso : ln shorter = ln (F - d) + ln (1+e3)) by (unfold shorter; rewrite ln_mult by assumption; reflexivity).
  assert (Llo : ln longer = ln (F + d) + ln (1+e4)) by (unfold longer; rewrite ln_mult by assumption; reflexivity).
  assert (La : ln a = ln behind + ln ahead + ln (1+e5)) by (unfold a; rewrite !ln_mult by pos; reflexivity).
  assert (Lb : ln b = ln shorter + ln longer + ln (1+e6)) by (unfold b; rewrite !ln_mult by pos; reflexivity).
  assert (Lp : ln p = ln ahead + ln longer + ln (1+e7)) by (unfold p; rewrite !ln_mult by pos; reflexivity).
  assert (Lm : ln m = ln behind + ln shorter + ln (1+e8)) by (unfold m; rewrite !ln_mult by pos; reflexivity).
  assert (Lch : ln ch = (ln a + ln r + ln (1+e9))/2 + ln (1+e11)) by (unfold ch; rewrite ln_mult by pos;
    rewrite ln_sqrt' by pos; rewrite !ln_mult by pos; reflexivity).
  assert (Lsh : ln sh = (ln b + ln r + ln (1+e10))/2 + ln (1+e12)) by (unfold sh; rewrite ln_mult by pos;
    rewrite ln_sqrt' by pos; rewrite !ln_mult by pos; reflexivity).
  assert (Lsm : ln smaller = ln ch + ln sh + ln (1+e13)) by (unfold smaller; rewrite !ln_mult by pos; reflexivity).
  assert (Llp : ln (larger p) = ln p + ln r + ln (1+e14)) by (unfold larger; rewrite !ln_mult by pos; reflexivity).
  assert (Llm : ln (larger m) = ln m + ln r + ln (1+e14)) by (unfold larger; rewrite !ln_mult by pos; reflexivity).
  set (x := ln ((F - d)*(F + d)/((d - D)*(d + D))) / 2) in *.
  set (y := ln ((d - D)*(F - d)/((d + D)*(F + d))) / 2) in *.
  assert (Ex : x = (ln (F-d) + ln (F+d) - ln (d-D) - ln (d+D))/2).
  { unfold x. unfold Rdiv at 2. rewrite ln_mult, ln_Rinv, !ln_mult by (try apply Rinv_0_lt_compat; pos). field. }
  assert (Ey : y = (ln (d-D) + ln (F-d) - ln (d+D) - ln (F+d))/2).
  { unfold y. unfold Rdiv at 2. rewrite ln_mult, ln_Rinv, !ln_mult by (try apply Rinv_0_lt_compat; pos). field. }
  set (tau := ln sh - ln ch - x). set (mu := ln ls - ln lc - y).
  assert (LN : forall e, Rabs e <= u -> - K <= ln (1+e) <= K). { intros e He. apply Rabs_le_between. apply ln1p; lra. }
  assert (Plc : 0 < lc /\ 0 < ls).
  { destruct Hl as [[-> ->]|[-> ->]]; split; try assumption; unfold larger; pos. }
  destruct Plc as [Plc Pls].
  assert (T : Rabs tau <= 9*K /\ Rabs mu <= 9*K /\ Rabs (tau - mu) <= 9*K).
  { destruct (nine _ _ _ _ _ _ _ _ _ _ _ _ _ _ K (LN _ H1) (LN _ H2) (LN _ H3) (LN _ H4) (LN _ H5) (LN _ H6) (LN _ H7)
    (LN _ H8) (LN _ H9) (LN _ H10) (LN _ H11) (LN _ H12) (LN _ H13) (LN _ H14))
      as [[N1 [N2 N3]] [N4 N5]].
    match type of N1 with Rabs ?t <= _ => assert (Et : tau = t) by (unfold tau;
      rewrite Lsh, Lch, La, Lb, Lbh, Lah, Lso, Llo, Ex; field) end.
    rewrite <- Et in N1, N3, N5.
    destruct Hl as [[El1 El2]|[El1 El2]].
    - match type of N2 with Rabs ?t <= _ => assert (Em : mu = t) by (unfold mu;
      rewrite El1, El2, Llp, Lsm, Lsh, Lch, Lp, La, Lb, Lbh, Lah, Lso, Llo, Ey; field) end.
      rewrite <- Em in N2, N3. auto.
    - match type of N4 with Rabs ?t <= _ => assert (Em : mu = t) by (unfold mu;
      rewrite El1, El2, Llm, Lsm, Lsh, Lch, Lm, La, Lb, Lbh, Lah, Lso, Llo, Ey; field) end.
      rewrite <- Em in N4, N5. auto. }
  destruct T as [Tt [Tm Ttm]].
  pose (L1' := (F+D)/2). pose (L2' := (F-D)/2).
  assert (Pl : 0 <= L1' /\ 0 <= L2') by (unfold L1', L2'; split; lra). destruct Pl as [PL1 PL2].
  assert (K9 : 0 <= 9*K) by lra.
  pose proof (planar L1' L2' d x y tau mu (9*K) PL1 PL2 K9 E0 Ed Tt Tm Ttm) as PLN. simpl in PLN.
  replace (x + tau) with (ln sh - ln ch) in PLN by (unfold tau; ring).
    replace (y + mu) with (ln ls - ln lc) in PLN by (unfold mu; ring).
  set (th := ang (ln sh - ln ch)) in *. set (be := ang (ln ls - ln lc)) in *.
  destruct (pair_ang ch sh Pc Ps) as [C1 S1]. destruct (pair_ang lc ls Plc Pls) as [C2 S2]. fold th in C1, S1.
    fold be in C2, S2.
  assert (Qc : 0 < ch*ch + sh*sh) by (apply Rplus_lt_0_compat; apply Rmult_lt_0_compat; assumption).
  assert (Ql : 0 < lc*lc + ls*ls) by (apply Rplus_lt_0_compat; apply Rmult_lt_0_compat; assumption).
  rewrite bent_eq by assumption. rewrite C1, S1. rewrite lift_eq by assumption. rewrite C2, S2.
  set (W := fun l1 l2 => v3 0 (sg * (l2 * sin (th - be) - l1 * sin be)) (sg * (l1 * cos be + l2 * cos (th - be)))).
  assert (EW : v3 0 (sg * (cos be * (L2 * sin th) - sin be * (L1 + L2 * cos th))) (sg * (sin be * (L2 * sin th) + cos
    be * (L1 + L2 * cos th))) = W L1 L2).
  { unfold W. rewrite sin_minus, cos_minus. f_equal; ring. }
  rewrite EW.
  apply Rle_trans with (1 := vsub_tri _ (W L1' L2') _). rewrite Rplus_comm.
  assert (sg2 : sg * sg = 1) by (destruct Hsg as [->| ->]; ring).
  apply Rplus_le_compat.
  - (* the planar theorem *)
    unfold vnorm. apply Rle_trans with (sqrt ((9*K*F)*(9*K*F))).
    2: { rewrite sqrt_square. apply Rle_refl. apply Rmult_le_pos; [exact K9 | clear -Hd HF; lra]. }
    apply sqrt_le_1_alt. unfold v2n, vsub, W; simpl.
    replace ((L1' + L2')) with F in PLN by (unfold L1', L2'; field).
    replace (9*K*F*(9*K*F)) with (F*(9*K)*(F*(9*K))) by ring. eapply Rle_trans. 2: exact PLN. right.
    set (A := L2' * sin (th - be) - L1' * sin be). set (B := L1' * cos be + L2' * cos (th - be)).
    replace ((0-0)*(0-0) + (sg*A - 0)*(sg*A-0) + (sg*B - sg*d)*(sg*B - sg*d)) with (sg*sg*(A*A + (B-d)*(B-d))) by ring.
      rewrite sg2. ring.
  - assert (EV : vsub (W L1 L2) (W L1' L2') = vadd (vscale (L1 - L1') (v3 0 (-sg * sin be) (sg * cos be))) (vscale (L2
    - L2') (v3 0 (sg * sin (th - be)) (sg * cos (th - be))))).
    { unfold W, vsub, vadd, vscale; simpl. f_equal; ring. }
    rewrite EV. apply Rle_trans with (1 := vtri _ _). rewrite !vnorm_scale.
    assert (U1 : vnorm (v3 0 (-sg * sin be) (sg * cos be)) = 1).
    { unfold vnorm, v2n; simpl. rewrite <- sqrt_1. f_equal. pose proof (sin2_cos2 be) as Q. unfold Rsqr in Q.
      replace (0*0 + -sg*sin be*(-sg*sin be) + sg*cos be*(sg*cos be)) with (sg*sg*(sin be*sin be+cos be*cos be)) by
        ring. rewrite sg2, Q. ring. }
    assert (U2 : vnorm (v3 0 (sg * sin (th-be)) (sg * cos (th-be))) = 1).
    { unfold vnorm, v2n; simpl. rewrite <- sqrt_1. f_equal. pose proof (sin2_cos2 (th-be)) as Q. unfold Rsqr in Q.
      replace (0*0 + sg*sin (th-be)*(sg*sin (th-be)) + sg*cos (th-be)*(sg*cos (th-be))) with (sg*sg*(sin (th-be)*sin
        (th-be)+cos (th-be)*cos (th-be))) by ring. rewrite sg2, Q. ring. }
    rewrite U1, U2. unfold L1', L2'. lra.
Qed.
End Rounded.
